// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/scene_assembly.h"

#include "dismantle/files/text_name.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/math/quat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace dismantle {

namespace {

/// The largest deviation of a matrix that still counts as a rotation (or a scaled rotation): float rounding.
constexpr double kRigidTolerance = 1e-6;

/// Largest number of tree nodes, relative to the limit of components: beyond lies a scene made to explode.
constexpr std::size_t kNodesPerComponent = 4;

/// A linear map as a rotation applied after a remainder that is baked into the mesh.
struct SplitLinear {
  Mat3 rotation;
  Mat3 baked;
};

/// Splits a uniformly scaled rotation (negative: mirrored) into the two; anything else is baked whole.
SplitLinear split(const Mat3& linear) {
  const double cubed = determinant(linear);
  const double scale = std::cbrt(cubed);
  const Mat3 gram = transposed(linear) * linear;
  double deviation = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      deviation = std::max(deviation, std::abs(gram.row[i][k] - (i == k ? scale * scale : 0)));
  if (!(deviation <= kRigidTolerance * scale * scale) || scale == 0) return {{}, linear};

  const double tidy = std::abs(std::abs(scale) - 1) < kRigidTolerance ? std::copysign(1.0, scale) : scale;
  Mat3 rotation;
  for (int i = 0; i < 3; ++i) rotation.row[i] = linear.row[i] / scale;
  const Mat3 exact = rotation == Mat3{} ? rotation : mat3_from_quat(quat_from_mat3(rotation));
  return {exact, {{{tidy, 0, 0}, {0, tidy, 0}, {0, 0, tidy}}}};
}

std::array<double, 9> numbers_of(const Mat3& m) {
  return {m.row[0].x, m.row[0].y, m.row[0].z, m.row[1].x, m.row[1].y, m.row[1].z, m.row[2].x, m.row[2].y, m.row[2].z};
}

class Importer {
 public:
  Importer(const Scene& scene, const SceneFile& file, const SceneMeshLoader& load, const ImportOptions& options)
      : scene_(scene), name_(file.name), scale_(file.millimetres_per_unit), load_(load), options_(options) {}

  Result<Assembly> import() {
    const bool one_root = scene_.roots.size() == 1 && !scene_.nodes[scene_.roots[0]].mesh;
    if (!one_root) assembly_.tree.push_back({name_, 0});
    for (const std::size_t root : scene_.roots) pending_.push_back({root, 0, {}});
    std::reverse(pending_.begin(), pending_.end());
    for (std::size_t done = 0; !pending_.empty(); ++done) {
      const Pending next = pending_.back();
      pending_.pop_back();
      if (const std::optional<Error> error = visit(next)) return *error;
      if (!report_progress(options_.progress, "reading",
                           static_cast<double>(done) / static_cast<double>(scene_.nodes.size())))
        return cancelled();
    }
    if (assembly_.components.empty())
      return Error{ErrorKind::Unreadable, name_ +
                                              " holds no component (no triangle with an area); export it again as "
                                              "meshes"};
    make_names_unique(assembly_.components);
    return std::move(assembly_);
  }

 private:
  struct Pending {
    std::size_t node;
    std::uint32_t parent;
    SceneTransform world_from_parent;
  };
  /// A mesh under one baked linear map.
  struct Variant {
    std::shared_ptr<const TriangleMesh> mesh;
    MeshFaults faults;
  };

  std::optional<Error> visit(const Pending& at) {
    const SceneNode& node = scene_.nodes[at.node];
    const SceneTransform world = at.world_from_parent * node.parent_from_node;
    const std::string label = node.name.empty() ? "node " + std::to_string(at.node) : node.name;
    if (assembly_.tree.size() > kNodesPerComponent * options_.limits.components + 2 * scene_.nodes.size())
      return too_large();
    assembly_.tree.push_back({label, at.parent});
    const auto tree_node = static_cast<std::uint32_t>(assembly_.tree.size() - 1);

    if (node.mesh) {
      std::uint32_t leaf = tree_node;
      if (!node.children.empty()) {  // a component is a leaf of the tree
        leaf = static_cast<std::uint32_t>(assembly_.tree.size());
        assembly_.tree.push_back({label, tree_node});
      }
      if (auto error = add_component(label, *node.mesh, world, leaf)) return error;
    }
    for (std::size_t i = node.children.size(); i-- > 0;) pending_.push_back({node.children[i], tree_node, world});
    return std::nullopt;
  }

  std::optional<Error> add_component(const std::string& label, std::size_t mesh, const SceneTransform& world,
                                     std::uint32_t tree_node) {
    const SceneMesh* surface = nullptr;
    if (auto error = surface_of(mesh, surface)) return error;
    if (surface->mesh.faces.empty()) return std::nullopt;
    triangles_ += surface->mesh.faces.size();
    if (triangles_ > options_.limits.triangles || assembly_.components.size() == options_.limits.components)
      return too_large();

    const SplitLinear linear = split(world.linear);
    const Variant& variant = variant_of(mesh, surface->mesh, linear.baked);
    if (variant.mesh->faces.empty()) return std::nullopt;
    Component c;
    c.name = label;
    c.mesh = variant.mesh;
    c.faults = variant.faults;
    c.color = surface->color;
    c.tree_node = tree_node;
    c.assembly_from_mesh = {linear.rotation, scale_ * world.translation};
    for (const Vec3& p : c.mesh->vertices) {
      const Vec3 placed = c.assembly_from_mesh * p;
      if (!is_finite(placed) || max_abs(placed) > kLargestCoordinate || max_abs(p) > kLargestCoordinate)
        return Error{ErrorKind::Unreadable, name_ + " cannot be used (a coordinate of " + in_quotes(label) +
                                                " is further out than a thousand kilometres); check the units"};
    }
    assembly_.components.push_back(std::move(c));
    return std::nullopt;
  }

  Error too_large() const {
    return {ErrorKind::Unreadable, name_ + " is too large (more than " + std::to_string(options_.limits.triangles) +
                                       " triangles or " + std::to_string(options_.limits.components) +
                                       " components, or endless nesting); simplify it or load a part of it"};
  }

  std::optional<Error> surface_of(std::size_t mesh, const SceneMesh*& surface) {
    const auto [place, is_new] = surfaces_.try_emplace(mesh);
    surface = &place->second;
    if (!is_new) return std::nullopt;
    Result<SceneMesh> read = load_(mesh, options_.limits.triangles - triangles_);
    if (!read) return read.error();
    place->second = std::move(*read);
    return std::nullopt;
  }

  const Variant& variant_of(std::size_t mesh, const TriangleMesh& base, const Mat3& baked) {
    const auto [place, is_new] = variants_.try_emplace({mesh, numbers_of(baked)});
    if (!is_new) return place->second;
    TriangleMesh scaled = base;
    for (Vec3& p : scaled.vertices) p = scale_ * (baked * p);
    if (determinant(baked) < 0)
      for (Face& face : scaled.faces) std::swap(face.v[1], face.v[2]);
    CleanedMesh cleaned = clean_mesh(scaled);
    place->second = {std::make_shared<const TriangleMesh>(std::move(cleaned.mesh)), cleaned.faults};
    return place->second;
  }

  const Scene& scene_;
  std::string name_;
  double scale_;  // millimetres per unit of the file
  const SceneMeshLoader& load_;
  const ImportOptions& options_;
  Assembly assembly_;
  std::vector<Pending> pending_;  // a stack: nodes may be nested deeper than functions may
  std::map<std::size_t, SceneMesh> surfaces_;
  std::map<std::pair<std::size_t, std::array<double, 9>>, Variant> variants_;
  std::size_t triangles_ = 0;
};

}  // namespace

SceneTransform operator*(const SceneTransform& a, const SceneTransform& b) {
  return {a.linear * b.linear, a.linear * b.translation + a.translation};
}

Result<Assembly> assembly_from_scene(const Scene& scene, const SceneFile& file, const SceneMeshLoader& load,
                                     const ImportOptions& options) {
  Result<Assembly> assembly = Importer(scene, file, load, options).import();
  if (assembly) assembly->source_file = file.name;
  return assembly;
}

}  // namespace dismantle
