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

/// True if the text is UTF-8 (RFC 3629): no stray, missing or needless bytes, no surrogates, nothing above U+10FFFF.
inline bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xc2 ? 0
                               : lead < 0xe0 ? 2
                               : lead < 0xf0 ? 3
                               : lead < 0xf5 ? 4
                                             : 0;
    if (length == 0 || text.size() - i < length) return false;
    std::uint32_t code = length == 1 ? lead : lead & (0x7fu >> length);
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xc0) != 0x80) return false;
      code = code << 6 | (next & 0x3fu);
    }
    const bool is_short = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    if (is_short || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
    i += length;
  }
  return true;
}

/// Names are safe in JSON and on a terminal.
inline void require_clean(std::string_view name) {
  require(is_utf8(name), "a name in UTF-8");
  for (const char c : name)
    require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a name without control characters");
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
