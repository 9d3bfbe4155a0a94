// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace dismantle {

std::optional<ComponentId> Assembly::find(std::string_view name) const {
  for (std::uint32_t i = 0; i < components.size(); ++i)
    if (components[i].name == name) return ComponentId(i);
  return std::nullopt;
}

std::size_t triangle_count(const Assembly& assembly) {
  std::size_t count = 0;
  for (const Component& c : assembly.components) count += c.mesh->faces.size();
  return count;
}

std::vector<Vec3> assembled_vertices(const Component& component) {
  if (component.assembly_from_mesh == RigidTransform{}) return component.mesh->vertices;
  std::vector<Vec3> vertices;
  vertices.reserve(component.mesh->vertices.size());
  for (const Vec3& p : component.mesh->vertices) vertices.push_back(component.assembly_from_mesh * p);
  return vertices;
}

TriangleMesh assembled_mesh(const Component& component) {
  return {assembled_vertices(component), component.mesh->faces};
}

Aabb assembled_bounds(const Component& component) {
  Aabb box;
  for (const Vec3& p : component.mesh->vertices) box.extend(component.assembly_from_mesh * p);
  return box;
}

Aabb assembled_bounds(const Assembly& assembly) {
  Aabb box;
  for (const Component& c : assembly.components) box.extend(assembled_bounds(c));
  return box;
}

double default_tolerance(const Assembly& assembly) {
  return std::max(1e-5 * diagonal(assembled_bounds(assembly)), 2 * assembly.deflection) +
         2 * assembly.simplification_error;
}

void make_names_unique(std::vector<Component>& components) {
  std::unordered_set<std::string> taken;
  std::unordered_map<std::string, int> repeats;
  for (Component& c : components) {
    const std::string base = c.name.empty() ? "unnamed" : c.name;
    c.name = base;
    while (!taken.insert(c.name).second) {
      int& count = repeats.try_emplace(base, 1).first->second;
      c.name = base + "#" + std::to_string(++count);
    }
  }
}

}  // namespace dismantle
