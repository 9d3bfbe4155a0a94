// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/threemf/threemf_import.h"

#include "dismantle/formats/import/units.h"
#include "dismantle/formats/threemf/threemf_model.h"

#include <tinyxml2.h>

#include <map>
#include <string_view>
#include <utility>

namespace dismantle {

namespace {

constexpr const char* kRelationships = "_rels/.rels";
constexpr const char* kUsualModel = "3D/3dmodel.model";
constexpr std::size_t kMaxParts = 10'000;  // of a package that are models

std::string without_slash(std::string_view path) {
  return std::string(path.substr(path.empty() || path[0] != '/' ? 0 : 1));
}

/// The name of the part that the package's relationships call its model.
std::string root_part(const ThreeMfPartLoader& load) {
  const Result<std::string> text = load(kRelationships);
  tinyxml2::XMLDocument document;
  if (!text || document.Parse(text->data(), text->size()) != tinyxml2::XML_SUCCESS) return kUsualModel;
  const tinyxml2::XMLElement* root = document.RootElement();
  for (auto* e = root ? root->FirstChildElement() : nullptr; e != nullptr; e = e->NextSiblingElement()) {
    const char *type = e->Attribute("Type"), *target = e->Attribute("Target");
    if (type && target && std::string_view(type).ends_with("/3dmodel")) return without_slash(target);
  }
  return kUsualModel;
}

/// Builds the scene graph of a package; the meshes stay in the models.
class PackageReader {
 public:
  PackageReader(const std::string& name, const ThreeMfPartLoader& load, const ImportOptions& options)
      : name_(name), load_(load), options_(options), triangles_left_(options.limits.triangles) {}

  Result<Assembly> read() {
    const std::string root = root_part(load_);
    const Result<ThreeMfModel*> model = model_of(root);
    if (!model) return model.error();
    const std::string units = options_.units.empty() ? (*model)->units : options_.units;
    const Result<double> scale = millimetres_per_unit(units);
    if (!scale) return scale.error();

    for (const ThreeMfUse& item : (*model)->items) {
      const Result<std::size_t> node = add_node(item, root);
      if (!node) return node.error();
      if (*node != kNothing) scene_.roots.push_back(*node);
    }
    for (std::size_t done = 0; done < to_fill_.size(); ++done)  // filling one may append others
      if (const Result<Done> filled = fill(done); !filled) return filled.error();

    const SceneMeshLoader load_mesh = [&](std::size_t mesh, std::size_t) -> Result<SceneMesh> {
      return std::move(meshes_[mesh]->mesh);
    };
    Result<Assembly> assembly = assembly_from_scene(scene_, {name_, *scale}, load_mesh, options_);
    if (assembly) assembly->source_units = units;
    return assembly;
  }

 private:
  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

  /// An object whose components become nodes once.
  struct Expanded {
    const ThreeMfObject* object;
    std::string part;
    std::vector<std::size_t> children;     // nodes, by component
    std::vector<std::size_t> occurrences;  // nodes that get them
  };

  Error wrong(const std::string& why) const { return malformed({{}, name_}, "3MF", why); }

  Result<ThreeMfModel*> model_of(const std::string& part) {
    if (const auto known = models_.find(part); known != models_.end()) return &known->second;
    if (models_.size() == kMaxParts) return wrong("more than " + std::to_string(kMaxParts) + " model parts");
    if (!report_progress(options_.progress, "reading", -1)) return cancelled();
    const Result<std::string> text = load_(part);
    if (!text) {
      const std::string& message = text.error().message;
      return wrong(message.substr(0, message.rfind("; ")));
    }
    Result<ThreeMfModel> model = parse_3mf_model({*text, name_}, triangles_left_);
    if (!model) return model.error();
    for (const auto& [id, object] : model->objects) triangles_left_ -= object.mesh.mesh.faces.size();
    return &models_.emplace(part, std::move(*model)).first->second;
  }

  /// The node of one use of an object; kNothing for supports.
  Result<std::size_t> add_node(const ThreeMfUse& use, const std::string& from_part) {
    const std::string part = use.part.empty() ? from_part : without_slash(use.part);
    const Result<ThreeMfModel*> model = model_of(part);
    if (!model) return model.error();
    const auto found = (*model)->objects.find(use.object);
    if (found == (*model)->objects.end()) return wrong("object " + std::to_string(use.object) + " is not there");
    ThreeMfObject& object = found->second;
    if (object.is_support) return kNothing;

    SceneNode node;
    node.name = object.name.empty() ? "object " + std::to_string(use.object) : object.name;
    node.parent_from_node = use.placement;
    if (!object.mesh.mesh.faces.empty()) {
      const auto [place, is_new] = mesh_index_.try_emplace(&object, meshes_.size());
      if (is_new) meshes_.push_back(&object);
      node.mesh = place->second;
    }
    const std::size_t index = scene_.nodes.size();
    scene_.nodes.push_back(std::move(node));
    if (object.components.empty()) return index;
    const auto [place, is_new] = expanded_.try_emplace(&object, to_fill_.size());
    if (is_new) to_fill_.push_back({&object, part, {}, {}});
    Expanded& expanded = to_fill_[place->second];
    expanded.occurrences.push_back(index);
    scene_.nodes[index].children = expanded.children;  // complete if it was filled before
    return index;
  }

  Result<Done> fill(std::size_t index) {
    const ThreeMfObject& object = *to_fill_[index].object;
    const std::string part = to_fill_[index].part;
    std::vector<std::size_t> children;
    for (const ThreeMfUse& component : object.components) {
      const Result<std::size_t> node = add_node(component, part);
      if (!node) return node.error();
      if (*node != kNothing) children.push_back(*node);
    }
    to_fill_[index].children = children;
    for (const std::size_t occurrence : to_fill_[index].occurrences) scene_.nodes[occurrence].children = children;
    return Done{};
  }

  const std::string& name_;
  const ThreeMfPartLoader& load_;
  const ImportOptions& options_;
  std::size_t triangles_left_;
  std::map<std::string, ThreeMfModel> models_;  // by part; nodes of a map stay where they are
  Scene scene_;
  std::vector<ThreeMfObject*> meshes_;  // by the scene's mesh index
  std::map<const ThreeMfObject*, std::size_t> mesh_index_, expanded_;
  std::vector<Expanded> to_fill_;
};

}  // namespace

Result<Assembly> import_3mf(const std::string& name, const ThreeMfPartLoader& load, const ImportOptions& options) {
  return PackageReader(name, load, options).read();
}

}  // namespace dismantle
