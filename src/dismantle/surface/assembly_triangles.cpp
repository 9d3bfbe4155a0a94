// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/assembly_triangles.h"

#include "dismantle/bvh/bvh_build.h"
#include "dismantle/geometry/adjacency.h"

namespace dismantle {

namespace {

Aabb box_of(const TriangleMesh& mesh, std::size_t face) {
  Aabb box;
  for (const std::uint32_t v : mesh.faces[face].v) box.extend(mesh.vertices[v]);
  return box;
}

/// Fills one component's ranges from its mesh in the assembled state, in leaf order.
void fill_component(AssemblyTriangles& triangles, const TriangleMesh& mesh, ComponentId id) {
  const BvhComponent& range = triangles.bvh.components[id.value];
  const std::vector<std::uint8_t> features = representative_features(mesh);
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), Id<VertexTag>::kInvalid);
  std::uint32_t next = triangles.vertex_begin[id.value];
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    const std::uint32_t face = triangles.bvh.leaf_triangle[leaf] - range.leaf_begin;
    triangles.face_of[leaf] = FaceId(face);
    triangles.features[leaf] = features[face];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.faces[face].v[k];
      if (new_index[v] == Id<VertexTag>::kInvalid) {
        new_index[v] = next;
        triangles.vertices[next++] = mesh.vertices[v];
      }
      triangles.faces[leaf].v[k] = new_index[v];
    }
  }
  for (std::size_t v = 0; v < new_index.size(); ++v)
    if (new_index[v] == Id<VertexTag>::kInvalid) triangles.vertices[next++] = mesh.vertices[v];
}

}  // namespace

AssemblyTriangles make_assembly_triangles(const Assembly& assembly, const Executor& executor) {
  AssemblyTriangles triangles;
  const std::size_t count = assembly.components.size();
  std::vector<std::uint32_t> face_begin(count + 1, 0);
  triangles.vertex_begin.assign(count + 1, 0);
  for (std::size_t c = 0; c < count; ++c) {
    const TriangleMesh& mesh = *assembly.components[c].mesh;
    face_begin[c + 1] = face_begin[c] + static_cast<std::uint32_t>(mesh.faces.size());
    triangles.vertex_begin[c + 1] = triangles.vertex_begin[c] + static_cast<std::uint32_t>(mesh.vertices.size());
  }

  std::vector<TriangleMesh> meshes(count);
  std::vector<Aabb> boxes(face_begin[count]);
  executor.for_each_heavy(count, [&](std::size_t c) {
    meshes[c] = assembled_mesh(assembly.components[c]);
    for (std::size_t f = 0; f < meshes[c].faces.size(); ++f) boxes[face_begin[c] + f] = box_of(meshes[c], f);
  });
  triangles.bvh = bvh_build({boxes, face_begin}, executor);
  triangles.refit_plan = bvh_refit_plan(triangles.bvh);

  triangles.vertices.resize(triangles.vertex_begin[count]);
  triangles.faces.resize(boxes.size());
  triangles.face_of.resize(boxes.size());
  triangles.features.resize(boxes.size());
  executor.for_each_heavy(
      count, [&](std::size_t c) { fill_component(triangles, meshes[c], ComponentId(static_cast<std::uint32_t>(c))); });
  return triangles;
}

std::vector<Kdop16> bounds_at(const AssemblyTriangles& triangles, Span<const Vec3> vertices, double margin,
                              const Executor& executor) {
  return bvh_fit(triangles.bvh, triangles.refit_plan, {vertices, vertices, triangles.faces, margin}, executor);
}

}  // namespace dismantle
