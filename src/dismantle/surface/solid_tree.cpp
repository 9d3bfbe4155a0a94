// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_tree.h"

#include <utility>

namespace dismantle {

namespace {

/// Fills in the normals, and the faces at each vertex.
void find_normals(SolidTree& solid) {
  solid.normals.resize(solid.faces.size());
  solid.around_begin.assign(solid.vertices.size() + 1, 0);
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    solid.normals[f] = normalized(normal_unscaled(solid.triangle(f)));
    for (const std::uint32_t v : solid.faces[f].v) ++solid.around_begin[v + 1];
  }
  for (std::size_t v = 0; v < solid.vertices.size(); ++v) solid.around_begin[v + 1] += solid.around_begin[v];
  solid.around.resize(3 * solid.faces.size());
  std::vector<std::uint32_t> next(solid.around_begin.begin(), solid.around_begin.end() - 1);
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f)
    for (const std::uint32_t v : solid.faces[f].v) solid.around[next[v]++] = f;
}

}  // namespace

SolidTree make_solid_tree(const Component& component, const Executor& executor) {
  SolidTree solid;
  solid.vertices = assembled_vertices(component);
  solid.faces = component.mesh->faces;
  solid.has_outside = component.faults.bounds_solid();
  std::vector<RevolutionAxis> axes = revolution_axes(solid.vertices, solid.faces);
  std::vector<ThreadAxis> threads = thread_axes(solid.vertices, solid.faces, axes);
  std::vector<std::uint8_t> parts = thread_parts(solid.vertices, solid.faces, threads);
  add_cylinder_parts(solid.vertices, solid.faces, axes, parts);
  solid.tree = obb_tree_build(solid.vertices, solid.faces, executor, parts);
  if (!solid.tree.empty())
    solid.revolution = std::make_unique<RevolutionSurface>(solid.vertices, solid.faces, solid.tree.nodes,
                                                           std::move(axes), std::move(threads));
  if (solid.has_outside) find_normals(solid);
  return solid;
}

}  // namespace dismantle
