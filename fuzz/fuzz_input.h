// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

/// Declarations that the fuzz targets share. A target is one file with LLVMFuzzerTestOneInput; it feeds a parser and
/// aborts where what came out is not sound. tools/fuzz runs them; ctest replays their corpus.
namespace dismantle::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline MeshSource source_of(const std::uint8_t* data, std::size_t size) {
  return {text_of(data, size), "input"};
}

/// Aborts with a message where a property that a parser promises does not hold.
inline void require(bool holds, const char* property) {
  if (!holds) contract_failed("fuzz target required", property, "fuzz", 0);
}

/// An Error must be one sentence.
inline void require_sentence(const Error& error) {
  require(!error.message.empty() && error.message.find('\n') == std::string::npos, "an error of one line");
}

inline void require_sound(const TriangleMesh& mesh) {
  for (const Vec3& p : mesh.vertices) require(is_finite(p), "finite coordinates");
  for (const Face& f : mesh.faces)
    for (const std::uint32_t v : f.v) require(v < mesh.vertices.size(), "indices below the vertex count");
}

inline void require_sound(const Result<Assembly>& assembly) {
  if (!assembly) return require_sentence(assembly.error());
  require(!assembly->components.empty(), "a component");
  for (const Component& component : assembly->components) {
    require(component.mesh && !component.mesh->faces.empty(), "a mesh with triangles");
    require(component.tree_node < assembly->tree.size(), "a place in the tree");
    require_sound(*component.mesh);
    for (const Vec3& p : assembled_vertices(component)) require(is_finite(p), "finite assembled coordinates");
  }
}

/// Checks the parts as a parser gives them and the assembly that is made of them.
inline void require_sound(Result<std::vector<MeshPart>> parts) {
  if (!parts) return require_sentence(parts.error());
  const ImportOptions options;
  Result<AssemblyBuilder> builder = AssemblyBuilder::create("input", "mm", options);
  for (MeshPart& part : *parts) {
    require_sound(part.mesh);
    if (const auto error = builder->add(std::move(part))) return require_sentence(*error);
  }
  require_sound(builder->finish(""));
}

}  // namespace dismantle::fuzz
