// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_tree.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Two axes are one if the sine between their directions, and the share of the thread's radius by which they are apart,
/// are below this.
constexpr double kSameAxis = 1e-3;

/// Fills in the normals, and the faces at each vertex.
void find_normals(SolidTree& solid) {
  SolidTree::FaceNormals found;
  found.normals.resize(solid.faces.size());
  found.around_begin.assign(solid.vertices.size() + 1, 0);
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    found.normals[f] = normalized(normal_unscaled(solid.triangle(f)));
    for (const std::uint32_t v : solid.faces[f].v) ++found.around_begin[v + 1];
  }
  for (std::size_t v = 0; v < solid.vertices.size(); ++v) found.around_begin[v + 1] += found.around_begin[v];
  found.around.resize(3 * solid.faces.size());
  std::vector<std::uint32_t> next(found.around_begin.begin(), found.around_begin.end() - 1);
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f)
    for (const std::uint32_t v : solid.faces[f].v) found.around[next[v]++] = f;
  solid.face_normals = std::make_shared<const SolidTree::FaceNormals>(std::move(found));
  solid.normals = solid.face_normals->normals;
  solid.around_begin = solid.face_normals->around_begin;
  solid.around = solid.face_normals->around;
}

/// The cylinders and threads that are recognised in a shape.
struct Recognised {
  std::vector<RevolutionAxis> axes;
  std::vector<ThreadAxis> threads;
};

/// Threads of remeshed surfaces have axes that no cylinder has: crests and roots are surfaces of revolution, too.
void add_thread_axes(Recognised& found) {
  for (const ThreadAxis& thread : found.threads) {
    const RevolutionAxis own{thread.point, thread.direction};
    const auto same = std::find_if(found.axes.begin(), found.axes.end(), [&](const RevolutionAxis& axis) {
      return same_axis(own, axis, kSameAxis, kSameAxis * thread.max_radius);
    });
    if (same == found.axes.end()) {
      found.axes.push_back(own);
    } else {
      same->min_radius = own.min_radius;
      same->max_radius = own.max_radius;
    }
  }
}

/// Finds the surfaces of revolution of a solid with its tree.
void find_revolution(SolidTree& solid, Recognised found) {
  if (!solid.tree.empty())
    solid.revolution = std::make_unique<RevolutionSurface>(solid.vertices, solid.faces, solid.tree.nodes,
                                                           std::move(found.axes), std::move(found.threads));
}

}  // namespace

SolidTree make_displaced_tree(const SolidTree& solid, std::vector<Vec3> vertices, const Executor& executor) {
  SolidTree displaced;
  displaced.vertices = std::move(vertices);
  displaced.faces = solid.faces;
  displaced.has_outside = solid.has_outside;
  displaced.inside_out = solid.inside_out;
  displaced.normals = solid.normals;
  displaced.around_begin = solid.around_begin;
  displaced.around = solid.around;
  displaced.face_normals = solid.face_normals;
  Recognised found;
  if (solid.revolution) {
    const Span<const RevolutionAxis> axes = solid.revolution->axes();
    const Span<const ThreadAxis> threads = solid.revolution->threads();
    found = {{axes.begin(), axes.end()}, {threads.begin(), threads.end()}};
  }
  displaced.tree = obb_tree_refit(solid.tree, displaced.vertices, displaced.faces, executor);
  find_revolution(displaced, std::move(found));
  return displaced;
}

SolidTree make_solid_tree(const Component& component, const Executor& executor) {
  SolidTree solid;
  solid.vertices = assembled_vertices(component);
  solid.faces = component.mesh->faces;
  solid.has_outside = component.faults.bounds_solid();
  solid.inside_out = component.faults.open_edges == 0 && component.faults.inside_out;
  Recognised found;
  found.axes = revolution_axes(solid.vertices, solid.faces);
  found.threads = thread_axes(solid.vertices, solid.faces, found.axes);
  add_thread_axes(found);
  std::vector<std::uint8_t> parts = thread_parts(solid.vertices, solid.faces, found.threads);
  add_cylinder_parts(solid.vertices, solid.faces, found.axes, parts);
  solid.tree = obb_tree_build(solid.vertices, solid.faces, executor, parts);
  find_revolution(solid, std::move(found));
  if (solid.has_outside) find_normals(solid);
  return solid;
}

}  // namespace dismantle
