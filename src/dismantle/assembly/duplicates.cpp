// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/duplicates.h"

#include <algorithm>
#include <map>

namespace dismantle {

namespace {

/// Distance within which vertices coincide, as a share of the diagonal.
constexpr double kSamePlace = 1e-6;

bool coincide(const Component& a, const Component& b, double within) {
  if (a.mesh != b.mesh && a.mesh->faces != b.mesh->faces) return false;
  if (a.mesh->vertices.size() != b.mesh->vertices.size()) return false;
  for (std::size_t v = 0; v < a.mesh->vertices.size(); ++v) {
    const Vec3 apart = a.assembly_from_mesh * a.mesh->vertices[v] - b.assembly_from_mesh * b.mesh->vertices[v];
    if (max_abs(apart) > within) return false;
  }
  return true;
}

}  // namespace

std::vector<Duplicate> find_duplicates(const Assembly& assembly) {
  const double within = kSamePlace * diagonal(assembled_bounds(assembly));
  // By the first vertex along x: those that coincide are next to each other.
  struct First {
    double x;
    std::uint32_t component;
  };
  std::map<std::pair<std::size_t, std::size_t>, std::vector<First>> alike;  // by numbers of vertices and faces
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c) {
    const Component& component = assembly.components[c];
    if (component.mesh->vertices.empty()) continue;
    const Vec3 first = component.assembly_from_mesh * component.mesh->vertices.front();
    alike[{component.mesh->vertices.size(), component.mesh->faces.size()}].push_back({first.x, c});
  }
  std::vector<Duplicate> found;
  for (auto& [size, list] : alike) {
    std::sort(list.begin(), list.end(),
              [](const First& a, const First& b) { return a.x != b.x ? a.x < b.x : a.component < b.component; });
    std::vector<bool> is_one(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (is_one[i]) continue;
      std::vector<ComponentId> same{ComponentId(list[i].component)};
      for (std::size_t k = i + 1; k < list.size() && list[k].x - list[i].x <= within; ++k) {
        if (is_one[k] ||
            !coincide(assembly.components[list[i].component], assembly.components[list[k].component], within))
          continue;
        is_one[k] = true;
        same.emplace_back(list[k].component);
      }
      std::sort(same.begin(), same.end());
      for (std::size_t k = 1; k < same.size(); ++k) found.push_back({same[k], same[0]});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Duplicate& a, const Duplicate& b) { return a.component < b.component; });
  return found;
}

void remove_components(Assembly& assembly, Span<const ComponentId> components) {
  std::vector<bool> gone(assembly.components.size());
  for (const ComponentId c : components) gone[c.value] = true;
  std::vector<Component> left;
  for (std::size_t c = 0; c < gone.size(); ++c)
    if (!gone[c]) left.push_back(std::move(assembly.components[c]));
  assembly.components = std::move(left);
}

}  // namespace dismantle
