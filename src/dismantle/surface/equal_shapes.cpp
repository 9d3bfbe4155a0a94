// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/equal_shapes.h"

#include "dismantle/geometry/congruence.h"
#include "dismantle/surface/surface_congruence.h"

#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>

namespace dismantle {

namespace {

/// Two tessellations of one face are no further apart than so many times their deflection.
constexpr double kDeflections = 2;

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
    if (const std::optional<ComponentId> first = tessellated_otherwise(c, area)) return *first;
    alike.emplace(area, Shape{c, std::move(own)});
    by_area_.emplace(area, Surface{c, nullptr});
    return c;
  }

 private:
  /// The first component of the shape of a component whose faces were tessellated with other vertices.
  std::optional<ComponentId> tessellated_otherwise(ComponentId c, double area) {
    if (!(assembly_.deflection > 0) || assembly_[c].mesh->faces.empty()) return std::nullopt;
    std::unique_ptr<const ComparedSurface> own;
    const auto last = by_area_.upper_bound(area * (1 + kEqualArea));
    for (auto at = by_area_.lower_bound(area * (1 - kEqualArea)); at != last; ++at) {
      Surface& other = at->second;
      if (assembly_[other.first].mesh->faces.empty()) continue;
      if (!own) own = std::make_unique<const ComparedSurface>(*assembly_[c].mesh);
      if (!other.compared) other.compared = std::make_unique<const ComparedSurface>(*assembly_[other.first].mesh);
      if (surface_congruence(*own, *other.compared, kDeflections * assembly_.deflection)) return other.first;
    }
    return std::nullopt;
  }

  struct Surface {
    ComponentId first;
    std::unique_ptr<const ComparedSurface> compared;  // once it is needed
  };
  struct Shape {
    ComponentId first;
    MeshInvariants invariants;
  };

  const Assembly& assembly_;
  std::multimap<double, Surface> by_area_;  // of all shapes
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
