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

/// Fills one component's ranges of the streams from its mesh in the assembled state, in leaf order.
void fill_component(AssemblyTriangles& streams, const TriangleMesh& mesh, ComponentId id) {
  const BvhComponent& range = streams.bvh.components[id.value];
  const std::vector<std::uint8_t> features = representative_features(mesh);
  std::vector<std::uint32_t> place(mesh.vertices.size(), Id<VertexTag>::kInvalid);
  std::uint32_t next = streams.vertex_begin[id.value];
  for (NodeIndex leaf = range.leaf_begin; leaf < range.leaf_end; ++leaf) {
    const std::uint32_t face = streams.bvh.leaf_triangle[leaf] - range.leaf_begin;
    streams.face_of[leaf] = FaceId(face);
    streams.features[leaf] = features[face];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.faces[face].v[k];
      if (place[v] == Id<VertexTag>::kInvalid) {
        place[v] = next;
        streams.vertices[next++] = mesh.vertices[v];
      }
      streams.faces[leaf].v[k] = place[v];
    }
  }
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] == Id<VertexTag>::kInvalid) streams.vertices[next++] = mesh.vertices[v];
}

}  // namespace

AssemblyTriangles make_assembly_triangles(const Assembly& assembly, const Executor& executor) {
  AssemblyTriangles streams;
  const std::size_t count = assembly.components.size();
  std::vector<std::uint32_t> face_begin(count + 1, 0);
  streams.vertex_begin.assign(count + 1, 0);
  for (std::size_t c = 0; c < count; ++c) {
    const TriangleMesh& mesh = *assembly.components[c].mesh;
    face_begin[c + 1] = face_begin[c] + static_cast<std::uint32_t>(mesh.faces.size());
    streams.vertex_begin[c + 1] = streams.vertex_begin[c] + static_cast<std::uint32_t>(mesh.vertices.size());
  }

  std::vector<TriangleMesh> meshes(count);
  std::vector<Aabb> boxes(face_begin[count]);
  executor.for_each_heavy(count, [&](std::size_t c) {
    meshes[c] = assembled_mesh(assembly.components[c]);
    for (std::size_t f = 0; f < meshes[c].faces.size(); ++f) boxes[face_begin[c] + f] = box_of(meshes[c], f);
  });
  streams.bvh = bvh_build({boxes, face_begin}, executor);
  streams.refit_plan = bvh_refit_plan(streams.bvh);

  streams.vertices.resize(streams.vertex_begin[count]);
  streams.faces.resize(boxes.size());
  streams.face_of.resize(boxes.size());
  streams.features.resize(boxes.size());
  executor.for_each_heavy(
      count, [&](std::size_t c) { fill_component(streams, meshes[c], ComponentId(static_cast<std::uint32_t>(c))); });
  return streams;
}

std::vector<Kdop16> bounds_at(const AssemblyTriangles& streams, Span<const Vec3> vertices, double margin,
                              const Executor& executor) {
  return bvh_fit(streams.bvh, streams.refit_plan, {vertices, vertices, streams.faces, margin}, executor);
}

}  // namespace dismantle
