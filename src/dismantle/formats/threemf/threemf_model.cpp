// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/threemf/threemf_model.h"

#include "dismantle/files/text_name.h"
#include "dismantle/files/text_scan.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace dismantle {

using tinyxml2::XMLElement;

namespace {

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Calls `visit` with each child element of a name, whatever its prefix, until it returns false.
template <class Visit>
bool for_each(const XMLElement& parent, std::string_view name, const Visit& visit) {
  for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    if (local_name(e->Name()) == name && !visit(*e)) return false;
  return true;
}

const XMLElement* child(const XMLElement& parent, std::string_view name) {
  const XMLElement* found = nullptr;
  for_each(parent, name, [&](const XMLElement& e) { return (found = &e) == nullptr; });
  return found;
}

/// The value of an attribute, whatever its prefix; empty if there is none.
std::string_view attribute(const XMLElement& element, std::string_view name) {
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    if (local_name(a->Name()) == name) return a->Value();
  return {};
}

std::optional<double> number(const XMLElement& element, const char* name) {
  return to_double(trimmed(attribute(element, name)));
}

std::optional<std::int64_t> integer(const XMLElement& element, const char* name) {
  return to_integer(trimmed(attribute(element, name)));
}

/// The colour of "#RRGGBB" or "#RRGGBBAA".
std::optional<Color> color_of(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  std::array<float, 4> channels{0, 0, 0, 1};
  for (std::size_t i = 0; 2 * i + 2 < text.size(); ++i) {
    int value = 0;
    for (const char c : text.substr(2 * i + 1, 2)) {
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0) return std::nullopt;
      value = 16 * value + digit;
    }
    channels[i] = static_cast<float>(value) / 255;
  }
  return Color{channels[0], channels[1], channels[2], channels[3]};
}

/// The map of the text of a transform: twelve numbers, four rows of three, for row vectors.
std::optional<SceneTransform> transform_of(std::string_view text) {
  SceneTransform map;
  if (trimmed(text).empty()) return map;
  std::array<double, 12> m{};
  for (double& value : m) {
    const std::optional<double> next = to_double(take_word(text));
    if (!next) return std::nullopt;
    value = *next;
  }
  if (!take_word(text).empty()) return std::nullopt;
  map.linear = {{{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}}};
  map.translation = {m[9], m[10], m[11]};
  return map;
}

using Property = std::pair<std::int64_t, std::int64_t>;  // a group of properties, and an index in it

class ModelParser {
 public:
  ModelParser(const MeshSource& source, std::size_t triangle_limit)
      : source_(source), triangles_left_(triangle_limit) {}

  Result<ThreeMfModel> parse() {
    tinyxml2::XMLDocument document;
    if (document.Parse(source_.bytes.data(), source_.bytes.size()) != tinyxml2::XML_SUCCESS)
      return wrong("line " + std::to_string(document.ErrorLineNum()) + ": no well-formed XML");
    const XMLElement* model = document.RootElement();
    if (model == nullptr || local_name(model->Name()) != "model") return wrong("its root is no <model>");
    if (!read_units(*model)) return *error_;
    if (const XMLElement* resources = child(*model, "resources")) {
      for (const auto& [group, entry] : {std::pair("basematerials", "base"), {"colorgroup", "color"}})
        for_each(*resources, group, [&, name = entry](const XMLElement& e) { return read_colors(e, name); });
      if (!for_each(*resources, "object", [&](const XMLElement& e) { return read_object(e); })) return *error_;
    }
    if (const XMLElement* build = child(*model, "build"))
      if (!for_each(*build, "item", [&](const XMLElement& e) { return read_use(e, result_.items); })) return *error_;
    return std::move(result_);
  }

 private:
  Error wrong(const std::string& why) const { return malformed(source_, "3MF", why); }
  bool fail(const XMLElement& at, const std::string& why) {
    error_ = wrong("line " + std::to_string(at.GetLineNum()) + ": " + why);
    return false;
  }

  bool read_units(const XMLElement& model) {
    constexpr std::pair<std::string_view, const char*> kUnits[] = {
        {"micron", "um"}, {"millimeter", "mm"}, {"centimeter", "cm"}, {"inch", "in"}, {"foot", "ft"}, {"meter", "m"}};
    const std::string_view unit = attribute(model, "unit");
    if (unit.empty()) return true;
    for (const auto& [name, ours] : kUnits)
      if (name == unit) return result_.units = ours, true;
    return fail(model, "unknown unit " + in_quotes(unit));
  }

  bool read_colors(const XMLElement& group, const char* entry) {
    const std::optional<std::int64_t> id = integer(group, "id");
    std::int64_t index = 0;
    for_each(group, entry, [&](const XMLElement& e) {
      std::string_view text = attribute(e, "displaycolor");
      if (text.empty()) text = attribute(e, "color");
      if (const std::optional<Color> color = color_of(text); color && id) colors_[{*id, index}] = *color;
      ++index;
      return true;
    });
    return true;
  }

  bool read_object(const XMLElement& element) {
    const std::optional<std::int64_t> id = integer(element, "id");
    if (!id) return fail(element, "an object without id");
    ThreeMfObject object;
    object.name = attribute(element, "name");
    const std::string_view type = attribute(element, "type");
    object.is_support = type == "support" || type == "solidsupport";
    if (const XMLElement* components = child(element, "components"))
      if (!for_each(*components, "component", [&](const XMLElement& e) { return read_use(e, object.components); }))
        return false;
    if (const XMLElement* mesh = child(element, "mesh"))
      if (!read_mesh(*mesh, property_of(element, "pindex", {-1, -1}), object.mesh)) return false;
    if (!result_.objects.try_emplace(*id, std::move(object)).second)
      return fail(element, "a second object " + std::to_string(*id));
    return true;
  }

  Property property_of(const XMLElement& element, const char* index, Property otherwise) const {
    return {integer(element, "pid").value_or(otherwise.first), integer(element, index).value_or(otherwise.second)};
  }

  bool read_mesh(const XMLElement& element, Property of_object, SceneMesh& result) {
    TriangleMesh& mesh = result.mesh;
    const auto read_vertex = [&](const XMLElement& e) {
      const auto x = number(e, "x"), y = number(e, "y"), z = number(e, "z");
      if (!x || !y || !z) return fail(e, "a vertex without three finite numbers");
      mesh.vertices.push_back({*x, *y, *z});
      return true;
    };
    std::map<Property, double> areas;
    const auto read_triangle = [&](const XMLElement& e) {
      Face face;
      std::size_t corner = 0;
      for (const char* name : {"v1", "v2", "v3"}) {
        const std::optional<std::int64_t> v = integer(e, name);
        if (!v || *v < 0 || static_cast<std::uint64_t>(*v) >= mesh.vertices.size())
          return fail(e, "a triangle of vertices that are not there");
        face.v[corner++] = static_cast<std::uint32_t>(*v);
      }
      if (triangles_left_-- == 0) return fail(e, "more triangles than the limit");
      mesh.faces.push_back(face);
      areas[property_of(e, "p1", of_object)] += length(normal_unscaled(mesh.triangle(mesh.faces.size() - 1)));
      return true;
    };
    const XMLElement* vertices = child(element, "vertices");
    const XMLElement* triangles = child(element, "triangles");
    if (vertices == nullptr || triangles == nullptr) return true;
    if (!for_each(*vertices, "vertex", read_vertex) || !for_each(*triangles, "triangle", read_triangle)) return false;

    double largest = -1;
    for (const auto& [property, area] : areas) {
      const auto color = colors_.find(property);
      if (area <= largest) continue;
      largest = area;
      result.color = color == colors_.end() ? Color{} : color->second;
    }
    return true;
  }

  bool read_use(const XMLElement& element, std::vector<ThreeMfUse>& uses) {
    const std::optional<std::int64_t> object = integer(element, "objectid");
    const std::optional<SceneTransform> placement = transform_of(attribute(element, "transform"));
    if (!object) return fail(element, "a reference without objectid");
    if (!placement) return fail(element, "a transform that is not twelve finite numbers");
    uses.push_back({std::string(attribute(element, "path")), *object, *placement});
    return true;
  }

  const MeshSource& source_;
  std::size_t triangles_left_;
  ThreeMfModel result_;
  std::map<Property, Color> colors_;
  std::optional<Error> error_;
};

}  // namespace

Result<ThreeMfModel> parse_3mf_model(const MeshSource& source, std::size_t triangle_limit) {
  return ModelParser(source, triangle_limit).parse();
}

}  // namespace dismantle
