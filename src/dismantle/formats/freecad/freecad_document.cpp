// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/freecad/freecad_document.h"

#include "dismantle/files/text_name.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/math/quat.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace dismantle {

using tinyxml2::XMLElement;

namespace {

/// The largest number of occurrences that one array may claim.
constexpr std::int64_t kMaxElements = 1'000'000;

/// Properties of features that name objects whose shape goes into their own; FreeCAD hides these objects.
constexpr std::array<std::string_view, 15> kInputs = {"Base",    "Tool",    "Tools",     "Shapes",      "Source",
                                                      "Sources", "Objects", "Links",     "Profile",     "Sections",
                                                      "Spine",   "Faces",   "Originals", "BaseFeature", "Compound"};

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

std::string_view attribute(const XMLElement& element, const char* name) {
  const char* const text = element.Attribute(name);
  return text == nullptr ? std::string_view() : text;
}

/// The numbers of some attributes; none if one is not a finite number. `otherwise` for attributes that are missing.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers(const XMLElement& element,
                                                  const std::array<const char*, kCount>& names, double otherwise) {
  std::array<double, kCount> values;
  for (std::size_t i = 0; i < kCount; ++i) {
    const char* const text = element.Attribute(names[i]);
    const std::optional<double> value = text == nullptr ? otherwise : to_double(text);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

std::optional<SceneTransform> placement_of(const XMLElement& element) {
  const auto m = numbers<7>(element, {"Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3"}, 0);
  if (!m) return std::nullopt;
  SceneTransform placement;
  placement.translation = {(*m)[0], (*m)[1], (*m)[2]};
  const Quat q{(*m)[6], (*m)[3], (*m)[4], (*m)[5]};
  if (q.w != 0 || q.x != 0 || q.y != 0 || q.z != 0) placement.linear = mat3_from_quat(normalized(q));
  return placement;
}

/// All names in the links of a property: <Link value=>, <LinkSub value=>, <Link obj=>, within lists or not.
void collect_links(const XMLElement& property, std::vector<std::string>& names) {
  for (auto* e = property.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string_view kind = e->Name();
    if (kind == "Link" || kind == "LinkSub" || kind == "XLink") {
      for (const char* name : {"value", "obj", "name"})
        if (const std::string_view value = attribute(*e, name); !value.empty()) names.emplace_back(value);
    }
    if (kind == "LinkList" || kind == "LinkSubList" || kind == "XLinkList" || kind == "XLinkSubList")
      collect_links(*e, names);
  }
}

std::vector<std::string> links_in(const XMLElement& property) {
  std::vector<std::string> names;
  collect_links(property, names);
  return names;
}

Color color_of(std::uint32_t packed) {
  const auto channel = [&](int shift) { return static_cast<float>(packed >> shift & 0xff) / 255; };
  return {channel(24), channel(16), channel(8), 1};
}

/// Calls `visit` with the name and the first child of each property of an object.
template <class Visit>
void for_each_property(const XMLElement& object, const Visit& visit) {
  const XMLElement* const properties = object.FirstChildElement("Properties");
  if (properties == nullptr) return;
  for (auto* p = properties->FirstChildElement("Property"); p != nullptr; p = p->NextSiblingElement("Property"))
    if (p->FirstChildElement() != nullptr) visit(attribute(*p, "name"), *p, *p->FirstChildElement());
}

/// True if a feature of this type does not replace the objects that it is made of.
bool keeps_inputs(std::string_view type) {
  return !(type.starts_with("Part::") || type.starts_with("PartDesign::")) || type == "Part::Mirroring" ||
         type.ends_with("ShapeBinder");
}

class DocumentParser {
 public:
  Result<FreeCadDocument> parse(std::string_view document_xml, std::string_view gui_xml) {
    tinyxml2::XMLDocument xml;
    if (xml.Parse(document_xml.data(), document_xml.size()) != tinyxml2::XML_SUCCESS)
      return unreadable("line " + std::to_string(xml.ErrorLineNum()) +
                        " of its Document.xml is no well-formed XML; save it again");
    const XMLElement* const root = xml.RootElement();
    const XMLElement* const declared = root ? root->FirstChildElement("Objects") : nullptr;
    const XMLElement* const data = root ? root->FirstChildElement("ObjectData") : nullptr;
    if (declared == nullptr || data == nullptr)
      return unreadable("its Document.xml has no <Objects> and <ObjectData>; save it with a newer FreeCAD");

    for (auto* e = declared->FirstChildElement("Object"); e != nullptr; e = e->NextSiblingElement("Object")) {
      FreeCadObject object;
      object.name = object.label = attribute(*e, "name");
      object.type = attribute(*e, "type");
      if (result_.index.try_emplace(object.name, result_.objects.size()).second)
        result_.objects.push_back(std::move(object));
    }
    has_visibility_.resize(result_.objects.size());
    for (auto* e = data->FirstChildElement("Object"); e != nullptr; e = e->NextSiblingElement("Object")) {
      const auto found = result_.index.find(std::string(attribute(*e, "name")));
      if (found == result_.index.end()) continue;
      if (!read_object(*e, found->second))
        return unreadable("a number of its object " + in_quotes(found->first) + " is not finite; save it again");
    }
    read_gui(gui_xml);
    return std::move(result_);
  }

 private:
  bool read_object(const XMLElement& element, std::size_t index) {
    FreeCadObject& object = result_.objects[index];
    bool all_finite = true, is_clone = false;
    std::vector<std::string> inputs;
    std::optional<double> scale;
    bool has_scale_vector = false;
    for_each_property(element, [&](std::string_view name, const XMLElement& property, const XMLElement& value) {
      if (name == "Label") {
        if (const std::string_view label = attribute(value, "value"); !label.empty()) object.label = label;
      } else if (name == "Placement") {
        const std::optional<SceneTransform> placement = placement_of(value);
        all_finite &= placement.has_value();
        object.placement = placement.value_or(SceneTransform());
      } else if (name == "Visibility") {
        object.is_visible = attribute(value, "value") != "false";
        has_visibility_[index] = true;
      } else if (name == "Shape") {
        object.shape_file = attribute(value, "file");
      } else if (name == "Group") {
        object.group = links_in(property);
      } else if (name == "Proxy") {
        is_clone = attribute(value, "class").find("Clone") != std::string_view::npos;
      } else if (std::find(kInputs.begin(), kInputs.end(), name) != kInputs.end()) {
        collect_links(property, inputs);
      } else {
        all_finite &= read_link_property(name, property, value, object, scale, has_scale_vector);
      }
    });
    if (scale && !has_scale_vector) object.scale = {*scale, *scale, *scale};
    if (!is_clone && !keeps_inputs(object.type)) object.inputs = std::move(inputs);
    return all_finite;
  }

  /// @return false if a number is not finite
  static bool read_link_property(std::string_view name, const XMLElement& property, const XMLElement& value,
                                 FreeCadObject& object, std::optional<double>& scale, bool& has_scale_vector) {
    if (name == "LinkedObject") {
      FreeCadLink link{std::string(attribute(value, "file")), std::string(attribute(value, "name")),
                       std::string(attribute(value, "sub"))};
      if (link.name.empty()) link.name = attribute(value, "value");
      if (!link.name.empty()) object.link = std::move(link);
    } else if (name == "LinkTransform") {
      object.adds_placement = attribute(value, "value") == "true";
    } else if (name == "ElementCount") {
      const std::optional<std::int64_t> count = to_integer(attribute(value, "value"));
      object.element_count = static_cast<std::size_t>(std::clamp<std::int64_t>(count.value_or(0), 0, kMaxElements));
    } else if (name == "ElementList") {
      object.elements = links_in(property);
    } else if (name == "PlacementList") {
      object.placements_file = attribute(value, "file");
    } else if (name == "ScaleList") {
      object.scales_file = attribute(value, "file");
    } else if (name == "VisibilityList") {
      object.hidden_elements = attribute(value, "value");
      std::reverse(object.hidden_elements.begin(), object.hidden_elements.end());  // the first is the last digit
    } else if (name == "Scale" && attribute(property, "type") == "App::PropertyFloat") {
      const auto number = numbers<1>(value, {"value"}, 1);
      if (!number) return false;
      scale = (*number)[0];
    } else if (name == "ScaleVector") {
      const auto vector = numbers<3>(value, {"valueX", "valueY", "valueZ"}, 1);
      if (!vector) return false;
      object.scale = {(*vector)[0], (*vector)[1], (*vector)[2]};
      has_scale_vector = true;
    }
    return true;
  }

  void read_gui(std::string_view gui_xml) {
    tinyxml2::XMLDocument xml;
    if (gui_xml.empty() || xml.Parse(gui_xml.data(), gui_xml.size()) != tinyxml2::XML_SUCCESS) return;
    const XMLElement* const root = xml.RootElement();
    const XMLElement* const data = root ? root->FirstChildElement("ViewProviderData") : nullptr;
    for (auto* e = data ? data->FirstChildElement("ViewProvider") : nullptr; e != nullptr;
         e = e->NextSiblingElement("ViewProvider")) {
      const auto found = result_.index.find(std::string(attribute(*e, "name")));
      if (found == result_.index.end()) continue;
      FreeCadObject& object = result_.objects[found->second];
      for_each_property(*e, [&](std::string_view name, const XMLElement&, const XMLElement& value) {
        if (name == "Visibility" && !has_visibility_[found->second])
          object.is_visible = attribute(value, "value") != "false";
        const std::optional<std::int64_t> packed = to_integer(attribute(value, "value"));
        if (name == "ShapeColor" && packed) object.color = color_of(static_cast<std::uint32_t>(*packed));
      });
    }
  }

  FreeCadDocument result_;
  std::vector<bool> has_visibility_;  // by object
};

}  // namespace

Result<FreeCadDocument> parse_freecad_document(std::string_view document_xml, std::string_view gui_xml) {
  return DocumentParser().parse(document_xml, gui_xml);
}

}  // namespace dismantle
