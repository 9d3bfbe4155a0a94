// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/equal_shapes.h"

#include "dismantle/geometry/congruence.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace dismantle {

namespace {

/// The shapes that were met, by invariants.
class KnownShapes {
 public:
  explicit KnownShapes(const Assembly& assembly) : assembly_(assembly) {}

  /// The first component of the shape of a component; itself if its shape is new.
  ComponentId first_of(ComponentId c) {
    const TriangleMesh& mesh = *assembly_[c].mesh;
    MeshInvariants own = mesh_invariants(mesh);
    std::multimap<double, Shape>& alike = by_counts_[{own.vertices, own.faces}];
    largest_play_ = std::max(largest_play_, area_play(own));
    const auto last = alike.upper_bound(own.area + largest_play_);
    for (auto at = alike.lower_bound(own.area - largest_play_); at != last; ++at)
      if (congruence(mesh, own, *assembly_[at->second.first].mesh, at->second.invariants)) return at->second.first;
    const double area = own.area;
    alike.emplace(area, Shape{c, std::move(own)});
    return c;
  }

 private:
  struct Shape {
    ComponentId first;
    MeshInvariants invariants;
  };

  const Assembly& assembly_;
  /// By the numbers of vertices and faces, then by area.
  std::map<std::pair<std::size_t, std::size_t>, std::multimap<double, Shape>> by_counts_;
  double largest_play_ = 0;  // of the areas of all shapes [mm^2]
};

}  // namespace

std::vector<ComponentId> first_of_shape(const Assembly& assembly) {
  KnownShapes shapes(assembly);
  std::unordered_map<const TriangleMesh*, ComponentId> of_mesh;  // instances share their mesh
  std::vector<ComponentId> firsts;
  firsts.reserve(assembly.components.size());
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c) {
    const auto [at, is_new] = of_mesh.try_emplace(assembly.components[c].mesh.get(), ComponentId(c));
    if (is_new) at->second = shapes.first_of(ComponentId(c));
    firsts.push_back(at->second);
  }
  return firsts;
}

std::size_t shape_count(const std::vector<ComponentId>& firsts) {
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < firsts.size(); ++c) count += firsts[c] == ComponentId(c);
  return count;
}

}  // namespace dismantle
