// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/assembly_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <unordered_map>

namespace dismantle {

namespace {

class Writer {
 public:
  explicit Writer(const ByteSink& sink) : sink_(sink) {}

  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    sink_(&v, sizeof v);
  }
  template <class T>
  void array(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value<std::uint64_t>(values.size());
    if (!values.empty()) sink_(values.data(), values.size() * sizeof(T));
  }
  void text(const std::string& s) { array(std::vector<char>(s.begin(), s.end())); }

 private:
  const ByteSink& sink_;
};

/// Reads the bytes back; after a truncated piece all values are empty and ok() is false.
class Reader {
 public:
  explicit Reader(Span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  bool at_end() const { return offset_ == bytes_.size(); }
  std::size_t left() const { return bytes_.size() - offset_; }

  template <class T>
  T value() {
    T v{};
    if (sizeof v > left()) {
      ok_ = false;
      return v;
    }
    std::memcpy(&v, bytes_.data() + offset_, sizeof v);
    offset_ += sizeof v;
    return v;
  }
  /// A count of items of at least `min_size` bytes each.
  std::size_t count(std::size_t min_size) {
    const auto n = value<std::uint64_t>();
    if (n > left() / min_size) ok_ = false;
    return ok_ ? static_cast<std::size_t>(n) : 0;
  }
  template <class T>
  std::vector<T> array() {
    std::vector<T> values(count(sizeof(T)));
    if (!values.empty()) std::memcpy(values.data(), bytes_.data() + offset_, values.size() * sizeof(T));
    offset_ += values.size() * sizeof(T);
    return values;
  }
  std::string text() {
    const std::vector<char> characters = array<char>();
    return {characters.begin(), characters.end()};
  }

 private:
  Span<const std::byte> bytes_;
  std::size_t offset_ = 0;
  bool ok_ = true;
};

bool indices_valid(const TriangleMesh& mesh) {
  for (const Face& face : mesh.faces)
    for (const std::uint32_t v : face.v)
      if (v >= mesh.vertices.size()) return false;
  return true;
}

void write_faults(const MeshFaults& f, Writer& out) {
  for (const std::size_t count : {f.welded_vertices, f.degenerate_faces, f.boundary_edges, f.nonmanifold_edges,
                                  f.misoriented_edges, f.open_edges})
    out.value<std::uint64_t>(count);
  out.value<std::uint8_t>(f.inside_out ? 1 : 0);
}

MeshFaults read_faults(Reader& in) {
  MeshFaults f;
  for (std::size_t* count : {&f.welded_vertices, &f.degenerate_faces, &f.boundary_edges, &f.nonmanifold_edges,
                             &f.misoriented_edges, &f.open_edges})
    *count = in.value<std::uint64_t>();
  f.inside_out = in.value<std::uint8_t>() != 0;
  return f;
}

void write_component(const Component& c, std::uint32_t mesh, Writer& out) {
  out.text(c.name);
  out.value(mesh);
  out.value(c.assembly_from_mesh);
  out.value(c.color);
  out.value(c.tree_node);
  write_faults(c.faults, out);
}

}  // namespace

void write_assembly_bytes(const Assembly& assembly, const ByteSink& sink) {
  Writer out(sink);
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
  Reader in(bytes);
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
