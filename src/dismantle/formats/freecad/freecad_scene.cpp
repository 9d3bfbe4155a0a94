// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/freecad/freecad_scene.h"

#include "dismantle/files/byte_order.h"
#include "dismantle/files/text_name.h"
#include "dismantle/formats/freecad/freecad_document.h"

#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxDocuments = 10'000;
constexpr int kDeepest = 300;                // objects from the root to a leaf, links and groups alike
constexpr std::size_t kMaxSize = 4'000'000;  // nodes, and references to nodes

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

bool is_datum(std::string_view type) {
  constexpr std::string_view kDatums[] = {"PartDesign::Plane", "PartDesign::Line", "PartDesign::Point",
                                          "PartDesign::CoordinateSystem"};
  return std::find(std::begin(kDatums), std::end(kDatums), type) != std::end(kDatums) ||
         type.ends_with("ShapeBinder") || type.starts_with("Part::Datum") || type.starts_with("Sketcher::") ||
         type.starts_with("Part::Part2DObject");
}

SceneTransform scaled(Vec3 s) {
  return {{{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}}, {}};
}

/// A document, and which of its objects are shown elsewhere than at its root.
struct OpenDocument {
  fs::path file;
  FreeCadDocument content;
  std::unordered_set<std::string> inside;    // in a group, a body or an array
  std::unordered_set<std::string> consumed;  // made into another feature
};

/// The part of a node that all occurrences of an object share: what it looks like, in its own frame.
struct Content {
  std::optional<std::size_t> shape;
  std::vector<std::size_t> children;

  bool empty() const { return !shape && children.empty(); }
};

class SceneReader {
 public:
  explicit SceneReader(const FreeCadEntryReader& read) : read_(read) {}

  Result<FreeCadScene> read(const fs::path& file) {
    const Result<OpenDocument*> document = open(file);
    if (!document) return document.error();
    for (const FreeCadObject& object : (*document)->content.objects) {
      if ((*document)->inside.contains(object.name)) continue;
      if (const Result<Done> added = add_child(**document, object, result_.scene.roots, 0); !added)
        return added.error();
    }
    return std::move(result_);
  }

 private:
  Result<OpenDocument*> open(const fs::path& file) {
    const fs::path key = file.lexically_normal();
    const auto [place, is_new] = documents_.try_emplace(key);
    if (!is_new) return place->second.get();
    if (documents_.size() > kMaxDocuments) return unreadable("it links to too many documents; split it");
    const Result<std::string> xml = read_(key, "Document.xml");
    if (!xml) return xml.error();
    const Result<std::string> gui = read_(key, "GuiDocument.xml");
    Result<FreeCadDocument> content = parse_freecad_document(*xml, gui ? *gui : std::string());
    if (!content) return content.error();
    auto document = std::make_unique<OpenDocument>();
    document->file = key;
    document->content = std::move(*content);
    for (const FreeCadObject& object : document->content.objects) {
      if (object.group) document->inside.insert(object.group->begin(), object.group->end());
      document->inside.insert(object.elements.begin(), object.elements.end());
      document->consumed.insert(object.inputs.begin(), object.inputs.end());
    }
    place->second = std::move(document);
    return place->second.get();
  }

  static const FreeCadObject* find(const OpenDocument& document, const std::string& name) {
    const auto found = document.content.index.find(name);
    return found == document.content.index.end() ? nullptr : &document.content.objects[found->second];
  }

  /// Appends a node for an object where it is, unless it is hidden, consumed, or shows nothing.
  Result<Done> add_child(OpenDocument& document, const FreeCadObject& object, std::vector<std::size_t>& children,
                         int depth) {
    if (!object.is_visible || document.consumed.contains(object.name)) return Done{};
    const Result<const Content*> content = content_of(document, object, depth);
    if (!content) return content.error();
    if (!(*content)->empty()) children.push_back(add_node(object.label, object.placement, **content));
    return Done{};
  }

  std::size_t add_node(const std::string& name, const SceneTransform& placement, const Content& content) {
    size_ += 1 + content.children.size();
    SceneNode node{name, content.shape, content.children, placement};
    if (!node.mesh && node.children.size() == 1 && result_.scene.nodes[node.children[0]].name == name) {
      node = result_.scene.nodes[content.children[0]];  // it only places what it holds: one node will do
      node.parent_from_node = placement * node.parent_from_node;
    }
    result_.scene.nodes.push_back(std::move(node));
    return result_.scene.nodes.size() - 1;
  }

  Result<const Content*> content_of(OpenDocument& document, const FreeCadObject& object, int depth) {
    const auto [place, is_new] = contents_.try_emplace(&object);
    if (!is_new && place->second) return &*place->second;
    if (!is_new)
      return unreadable("its object " + in_quotes(object.name) + " links to itself, or is a part of itself; mend it");
    if (depth > kDeepest || size_ > kMaxSize)
      return unreadable("it holds too large an assembly, or too deep nesting; split it into several files");
    Result<Content> content = make_content(document, object, depth + 1);
    if (!content) return content.error();
    std::optional<Content>& kept = contents_[&object];
    kept = std::move(*content);
    return &*kept;
  }

  Result<Content> make_content(OpenDocument& document, const FreeCadObject& object, int depth) {
    Content content;
    if (object.link) return linked_content(document, object, depth);
    if (!object.shape_file.empty()) {  // a body, too: what is in its group makes its shape
      if (is_datum(object.type)) return content;
      content.shape = result_.shapes.size();
      result_.shapes.push_back({document.file, object.shape_file, object.color});
      return content;
    }
    const std::vector<std::string>& names = object.group ? *object.group : object.elements;
    const std::set<std::string> deeper = names_in_groups(document, names);
    for (const std::string& name : names) {
      const FreeCadObject* child = find(document, name);
      if (child == nullptr || deeper.contains(name)) continue;
      if (const Result<Done> added = add_child(document, *child, content.children, depth); !added) return added.error();
    }
    return content;
  }

  /// What the plain groups among some objects hold: a part lists it, too.
  static std::set<std::string> names_in_groups(const OpenDocument& document, const std::vector<std::string>& names) {
    std::set<std::string> deeper;
    for (const std::string& name : names)
      if (const FreeCadObject* child = find(document, name); child && child->group)
        deeper.insert(child->group->begin(), child->group->end());
    return deeper;
  }

  /// The content of a link: in the link's frame, with its scale.
  Result<Content> linked_content(OpenDocument& document, const FreeCadObject& link, int depth) {
    if (link.element_count > 0 && !link.elements.empty()) {  // each element is a link of its own
      Content content;
      for (const std::string& name : link.elements) {
        const FreeCadObject* element = find(document, name);
        if (element == nullptr) continue;
        if (const Result<Done> added = add_child(document, *element, content.children, depth); !added)
          return added.error();
      }
      return scaled_content(link.label, scaled(link.scale), std::move(content));
    }

    const Result<OpenDocument*> target_document = document_of(document, link);
    if (!target_document) return target_document.error();
    const FreeCadObject* target = find(**target_document, link.link->name);
    SceneTransform from_target;
    if (target != nullptr && link.adds_placement) from_target = target->placement;
    std::string_view path = link.link->path;
    for (std::size_t dot = path.find('.'); target != nullptr && dot != std::string_view::npos; dot = path.find('.')) {
      target = find(**target_document, std::string(path.substr(0, dot)));
      if (target != nullptr) from_target = from_target * target->placement;
      path.remove_prefix(dot + 1);
    }
    if (target == nullptr)
      return unreadable("its link " + in_quotes(link.label) + " leads to no object; mend the link");
    const Result<const Content*> of_target = content_of(**target_document, *target, depth);
    if (!of_target) return of_target.error();
    if ((*of_target)->empty()) return Content{};
    if (link.element_count == 0) return scaled_content(link.label, scaled(link.scale) * from_target, **of_target);
    return array_content(document, link, from_target, **of_target);
  }

  Result<Content> array_content(OpenDocument& document, const FreeCadObject& link, const SceneTransform& from_target,
                                const Content& of_target) {
    const std::vector<double> placements = doubles_of(document, link.placements_file);
    const std::vector<double> scales = doubles_of(document, link.scales_file);
    Content content;
    for (std::size_t i = 0; i < link.element_count; ++i) {
      if (size_ > kMaxSize)
        return unreadable("its array " + in_quotes(link.label) + " is too large; split it into several files");
      if (i < link.hidden_elements.size() && link.hidden_elements[i] == '0') continue;
      SceneTransform placement;
      if (7 * i + 7 <= placements.size()) {
        const double* p = &placements[7 * i];
        placement.translation = {p[0], p[1], p[2]};
        const Quat q{p[6], p[3], p[4], p[5]};
        const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        if (!is_finite(placement.translation) || !(norm < 1e100))
          return unreadable("a number of its array " + in_quotes(link.label) + " is not finite; save it again");
        if (norm > 0) placement.linear = mat3_from_quat(normalized(q));
      }
      if (3 * i + 3 <= scales.size())
        placement = placement * scaled({scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]});
      content.children.push_back(add_node(link.label + "_i" + std::to_string(i), placement * from_target,
                                          of_target));  // as FreeCAD names them
    }
    return scaled_content(link.label, scaled(link.scale), std::move(content));
  }

  /// The content itself, or a node for it if it is to be placed within the frame.
  Content scaled_content(const std::string& label, const SceneTransform& placement, Content content) {
    if (placement.linear == Mat3{} && placement.translation == Vec3{}) return content;
    Content placed;
    if (!content.empty()) placed.children.push_back(add_node(label, placement, content));
    return placed;
  }

  Result<OpenDocument*> document_of(OpenDocument& document, const FreeCadObject& link) {
    if (link.link->file.empty()) return &document;
    const fs::path file = document.file.parent_path() / link.link->file;
    Result<OpenDocument*> opened = open(file);
    if (opened || documents_[file.lexically_normal()]) return opened;
    documents_.erase(file.lexically_normal());
    return unreadable("its link " + in_quotes(link.label) + " leads to " + in_quotes(link.link->file) +
                      ", which cannot be read: " + opened.error().message);
  }

  /// The numbers of a list property: a count of items, then their doubles; empty if there is no such file.
  std::vector<double> doubles_of(const OpenDocument& document, const std::string& entry) const {
    if (entry.empty()) return {};
    const Result<std::string> bytes = read_(document.file, entry);
    constexpr std::size_t kHeader = 4;
    if (!bytes || bytes->size() <= kHeader) return {};
    std::vector<double> values((bytes->size() - kHeader) / sizeof(double));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = number_at<double>(bytes->data() + kHeader + i * sizeof(double), std::endian::little);
    return values;
  }

  const FreeCadEntryReader& read_;
  FreeCadScene result_;
  std::size_t size_ = 0;  // of the scene
  std::map<fs::path, std::unique_ptr<OpenDocument>> documents_;
  std::map<const FreeCadObject*, std::optional<Content>> contents_;  // none: being made
};

}  // namespace

Result<FreeCadScene> read_freecad_scene(const fs::path& file, const FreeCadEntryReader& read) {
  return SceneReader(read).read(file);
}

}  // namespace dismantle
