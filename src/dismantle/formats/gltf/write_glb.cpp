// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/write_glb.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/formats/gltf/glb_keys.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>

namespace dismantle {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUInt16 = 5123, kUInt32 = 5125;      // component types
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;  // what a view is for
constexpr const char* kLists[] = {"nodes", "meshes", "materials", "accessors", "bufferViews", "animations"};
constexpr std::size_t kLongestGlb = std::numeric_limits<std::uint32_t>::max() - 8;

double linear_from_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

void append_u32(std::string& bytes, std::size_t value) {
  const auto v = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
}

template <class T>
void append_values(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
}

class GlbBuilder {
 public:
  GlbBuilder(const Assembly& assembly, const GlbOptions& options) : assembly_(assembly), options_(options) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "dismantle"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", {0}}}};
    for (const char* list : kLists) json_[list] = Json::array();
  }

  Result<std::string> build() {
    add_tree();
    for (std::size_t i = 0; i < assembly_.components.size(); ++i) {
      add_component(i);
      if (binary_.size() > kLongestGlb) return too_large();
    }
    for (std::size_t i = 0; i < options_.animations.size(); ++i) {
      add_animation(options_.animations[i]);
      if (binary_.size() > kLongestGlb) return too_large();
      const double done = static_cast<double>(i + 1) / static_cast<double>(options_.animations.size());
      if (!report_progress(options_.progress, "writing animations", done))
        return Error{ErrorKind::Failed, "the file was not written (cancelled); start it again"};
    }
    for (const char* list : kLists)
      if (json_[list].empty()) json_.erase(list);  // glTF allows no empty lists
    if (!binary_.empty()) json_["buffers"] = {{{"byteLength", binary_.size()}}};
    return container();
  }

 private:
  static Error too_large() {
    return {ErrorKind::Failed, "the assembly is too large for a GLB file (4 GiB); simplify it"};
  }

  void add_tree() {
    std::vector<std::uint32_t> uses(assembly_.tree.size(), 0);  // children and components of each node
    for (std::size_t i = 1; i < assembly_.tree.size(); ++i) ++uses[assembly_.tree[i].parent];
    for (const Component& c : assembly_.components) ++uses[c.tree_node];
    exclusive_.resize(assembly_.tree.size());
    for (std::size_t i = 0; i < assembly_.tree.size(); ++i) {
      exclusive_[i] = uses[i] == 1 && i > 0;
      json_["nodes"].push_back({{"name", assembly_.tree[i].name}});
      if (i > 0) json_["nodes"][assembly_.tree[i].parent]["children"].push_back(i);
    }
    if (assembly_.tree.empty()) json_["nodes"].push_back({{"name", assembly_.source_file}});
  }

  void add_component(std::size_t index) {
    const Component& c = assembly_.components[index];
    std::size_t node = c.tree_node;
    const bool own_leaf = node < exclusive_.size() && exclusive_[node];
    if (!own_leaf) {  // a node of its own below the one that it shares
      node = json_["nodes"].size();
      json_["nodes"].push_back(Json::object());
      json_["nodes"][std::min<std::size_t>(c.tree_node, node - 1)]["children"].push_back(node);
    }

    RigidTransform placement = c.assembly_from_mesh;
    if (!options_.poses.empty()) placement = transform_from_pose(options_.poses[index]) * placement;
    Json& json = json_["nodes"][node];
    json["name"] = c.name;
    json["extras"]["component"] = c.name;
    json["extras"]["index"] = index;
    const Vec3 t = kMetresPerMillimetre * placement.translation;
    const Quat q = quat_from_mat3(placement.rotation);
    if (!(t == Vec3{})) json["translation"] = {t.x, t.y, t.z};
    if (!(q == Quat{})) json["rotation"] = {q.x, q.y, q.z, q.w};
    json["mesh"] = mesh_of(c);
    component_nodes_.push_back(node);
  }

  Pose rest(ComponentId c) const { return options_.poses.empty() ? Pose{} : options_.poses[c.value]; }

  void add_animation(const GlbAnimation& animation) {
    Json samplers = Json::array(), channels = Json::array();
    for (const GlbTrack& track : animation.tracks) {
      const auto stays = [at = rest(track.component)](const Frame& f) { return f.pose == at; };
      if (std::all_of(track.frames.begin(), track.frames.end(), stays)) continue;
      const GlbKeys keys = glb_keys(assembly_[track.component].assembly_from_mesh, track.frames);
      const std::size_t times = add_keys(keys.times, 1);
      for (const auto& [path, output] : {std::pair{"translation", add_keys(keys.translations, 3)},
                                         std::pair{"rotation", add_keys(keys.rotations, 4)}}) {
        channels.push_back({{"sampler", samplers.size()},
                            {"target", {{"node", component_nodes_[track.component.value]}, {"path", path}}}});
        samplers.push_back({{"input", times}, {"output", output}});  // linear, and spherically so
      }
    }
    if (!channels.empty())
      json_["animations"].push_back(
          {{"name", animation.name}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}});
  }

  /// The accessor for keys of `width` values each; equal keys share one.
  std::size_t add_keys(const std::vector<float>& values, std::size_t width) {
    const auto [place, is_new] = keys_.try_emplace({width, values}, json_["accessors"].size());
    if (!is_new) return place->second;
    static constexpr const char* kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    const std::size_t begin = binary_.size();
    append_values(binary_, values);
    Json accessor{{"bufferView", add_view(begin)},
                  {"componentType", kFloat},
                  {"count", values.size() / width},
                  {"type", kTypes[width]}};
    if (width == 1) {  // times have to tell their ends
      accessor["min"] = {values.front()};
      accessor["max"] = {values.back()};
    }
    json_["accessors"].push_back(std::move(accessor));
    return place->second;
  }

  std::size_t mesh_of(const Component& c) {
    const std::size_t material = material_of(c.color);
    const auto [place, is_new] = meshes_.try_emplace({c.mesh.get(), material}, json_["meshes"].size());
    if (!is_new) return place->second;
    const auto [accessors, is_new_surface] = accessors_.try_emplace(c.mesh.get());
    if (is_new_surface) accessors->second = {add_positions(*c.mesh), add_indices(*c.mesh)};
    json_["meshes"].push_back({{"name", c.name},
                               {"primitives",
                                {{{"attributes", {{"POSITION", accessors->second.positions}}},
                                  {"indices", accessors->second.indices},
                                  {"material", material}}}}});
    return place->second;
  }

  std::size_t add_view(std::size_t begin, std::optional<int> target = {}) {
    Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary_.size() - begin}};
    if (target) view["target"] = *target;
    json_["bufferViews"].push_back(std::move(view));
    return json_["bufferViews"].size() - 1;
  }

  std::size_t add_positions(const TriangleMesh& mesh) {
    std::vector<float> values;
    values.reserve(3 * mesh.vertices.size());
    std::array<float, 3> least, most;
    least.fill(std::numeric_limits<float>::max());
    most.fill(std::numeric_limits<float>::lowest());
    for (const Vec3& p : mesh.vertices) {
      for (int k = 0; k < 3; ++k) {
        const auto value = static_cast<float>(kMetresPerMillimetre * p[k]);
        const auto axis = static_cast<std::size_t>(k);
        least[axis] = std::min(least[axis], value);
        most[axis] = std::max(most[axis], value);
        values.push_back(value);
      }
    }
    const std::size_t begin = binary_.size();
    append_values(binary_, values);
    json_["accessors"].push_back({{"bufferView", add_view(begin, kArrayBuffer)},
                                  {"componentType", kFloat},
                                  {"count", mesh.vertices.size()},
                                  {"type", "VEC3"},
                                  {"min", least},
                                  {"max", most}});
    return json_["accessors"].size() - 1;
  }

  std::size_t add_indices(const TriangleMesh& mesh) {
    const bool small = mesh.vertices.size() < std::numeric_limits<std::uint16_t>::max();
    const std::size_t begin = binary_.size();
    small ? append_indices<std::uint16_t>(mesh) : append_indices<std::uint32_t>(mesh);
    json_["accessors"].push_back({{"bufferView", add_view(begin, kElementArrayBuffer)},
                                  {"componentType", small ? kUInt16 : kUInt32},
                                  {"count", 3 * mesh.faces.size()},
                                  {"type", "SCALAR"}});
    return json_["accessors"].size() - 1;
  }

  template <class Index>
  void append_indices(const TriangleMesh& mesh) {
    std::vector<Index> values;
    values.reserve(3 * mesh.faces.size());
    for (const Face& face : mesh.faces)
      for (const std::uint32_t v : face.v) values.push_back(static_cast<Index>(v));
    append_values(binary_, values);
  }

  std::size_t material_of(const Color& color) {
    const auto [place, is_new] = materials_.try_emplace({color.r, color.g, color.b, color.a}, materials_.size());
    if (!is_new) return place->second;
    Json material;
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor",
         {linear_from_srgb(color.r), linear_from_srgb(color.g), linear_from_srgb(color.b), double{color.a}}},
        {"metallicFactor", 0.1},
        {"roughnessFactor", 0.6}};
    material["doubleSided"] = true;  // sheets are seen from both sides
    if (color.a < 1) material["alphaMode"] = "BLEND";
    json_["materials"].push_back(std::move(material));
    return place->second;
  }

  Result<std::string> container() const {
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t length = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
    if (length > kLongestGlb) return too_large();
    std::string glb = "glTF";
    glb.reserve(length);
    append_u32(glb, 2);
    append_u32(glb, length);
    append_u32(glb, text.size());
    glb += "JSON" + text;
    if (binary_.empty()) return glb;
    append_u32(glb, binary_.size());
    glb.append("BIN\0", 4);
    return glb += binary_;
  }

  struct Accessors {
    std::size_t positions = 0, indices = 0;
  };

  const Assembly& assembly_;
  const GlbOptions& options_;
  Json json_;
  std::string binary_;
  std::vector<bool> exclusive_;  // of each tree node: a leaf with one component and nothing else
  std::vector<std::size_t> component_nodes_;
  std::map<std::pair<std::size_t, std::vector<float>>, std::size_t> keys_;
  std::unordered_map<const TriangleMesh*, Accessors> accessors_;
  std::map<std::pair<const TriangleMesh*, std::size_t>, std::size_t> meshes_;
  std::map<std::array<float, 4>, std::size_t> materials_;
};

}  // namespace

Result<std::string> glb_from_assembly(const Assembly& assembly, const GlbOptions& options) {
  DISMANTLE_EXPECT(options.poses.empty() || options.poses.size() == assembly.components.size());
  return GlbBuilder(assembly, options).build();
}

Result<Done> write_glb(const Assembly& assembly, const std::filesystem::path& file, const GlbOptions& options) {
  const Result<std::string> glb = glb_from_assembly(assembly, options);
  if (!glb) return glb.error();
  return write_file(file, *glb);
}

}  // namespace dismantle
