// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_bytes.h"

#include "dismantle/core/byte_stream.h"

#include <unordered_map>

namespace dismantle {

namespace {

bool indices_valid(const TriangleMesh& mesh) {
  for (const Face& face : mesh.faces)
    for (const std::uint32_t v : face.v)
      if (v >= mesh.vertices.size()) return false;
  return true;
}

void write_faults(const MeshFaults& f, ByteWriter& out) {
  for (const std::size_t count : {f.welded_vertices, f.degenerate_faces, f.boundary_edges, f.nonmanifold_edges,
                                  f.misoriented_edges, f.open_edges})
    out.value<std::uint64_t>(count);
  out.value<std::uint8_t>(f.inside_out ? 1 : 0);
}

MeshFaults read_faults(ByteReader& in) {
  MeshFaults f;
  for (std::size_t* count : {&f.welded_vertices, &f.degenerate_faces, &f.boundary_edges, &f.nonmanifold_edges,
                             &f.misoriented_edges, &f.open_edges})
    *count = in.value<std::uint64_t>();
  f.inside_out = in.value<std::uint8_t>() != 0;
  return f;
}

void write_component(const Component& c, std::uint32_t mesh, ByteWriter& out) {
  out.text(c.name);
  out.value(mesh);
  out.value(c.assembly_from_mesh);
  out.value(c.color);
  out.value(c.tree_node);
  write_faults(c.faults, out);
}

}  // namespace

void write_assembly_bytes(const Assembly& assembly, const ByteSink& sink) {
  ByteWriter out(sink);
  out.text(assembly.source_file);
  out.text(assembly.source_sha256);
  out.text(assembly.source_units);
  out.value(assembly.deflection);
  out.value(assembly.simplification_error);

  out.value<std::uint64_t>(assembly.tree.size());
  for (const TreeNode& node : assembly.tree) {
    out.value(node.parent);
    out.text(node.name);
  }

  std::unordered_map<const TriangleMesh*, std::uint32_t> index_of;
  std::vector<const TriangleMesh*> meshes;
  for (const Component& c : assembly.components)
    if (index_of.try_emplace(c.mesh.get(), meshes.size()).second) meshes.push_back(c.mesh.get());
  out.value<std::uint64_t>(meshes.size());
  for (const TriangleMesh* mesh : meshes) {
    out.array(mesh->vertices);
    out.array(mesh->faces);
  }

  out.value<std::uint64_t>(assembly.components.size());
  for (const Component& c : assembly.components) write_component(c, index_of[c.mesh.get()], out);
}

std::optional<Assembly> assembly_from_bytes(Span<const std::byte> bytes) {
  ByteReader in(bytes);
  Assembly assembly;
  assembly.source_file = in.text();
  assembly.source_sha256 = in.text();
  assembly.source_units = in.text();
  assembly.deflection = in.value<double>();
  assembly.simplification_error = in.value<double>();

  assembly.tree.resize(in.count(sizeof(std::uint32_t) + sizeof(std::uint64_t)));
  for (TreeNode& node : assembly.tree) {
    node.parent = in.value<std::uint32_t>();
    node.name = in.text();
    if (node.parent >= assembly.tree.size()) return std::nullopt;
  }

  std::vector<std::shared_ptr<const TriangleMesh>> meshes(in.count(2 * sizeof(std::uint64_t)));
  for (std::shared_ptr<const TriangleMesh>& mesh : meshes) {
    TriangleMesh m;
    m.vertices = in.array<Vec3>();
    m.faces = in.array<Face>();
    if (!in.ok() || !indices_valid(m)) return std::nullopt;
    mesh = std::make_shared<const TriangleMesh>(std::move(m));
  }

  assembly.components.resize(in.count(sizeof(RigidTransform)));
  for (Component& c : assembly.components) {
    c.name = in.text();
    const auto mesh = in.value<std::uint32_t>();
    c.assembly_from_mesh = in.value<RigidTransform>();
    c.color = in.value<Color>();
    c.tree_node = in.value<std::uint32_t>();
    c.faults = read_faults(in);
    if (!in.ok() || mesh >= meshes.size() || c.tree_node >= assembly.tree.size()) return std::nullopt;
    c.mesh = meshes[mesh];
  }
  if (!in.ok() || !in.at_end()) return std::nullopt;
  return assembly;
}

}  // namespace dismantle
