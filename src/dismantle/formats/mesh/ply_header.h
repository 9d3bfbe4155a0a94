// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/mesh_source.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// How the body of a PLY file writes its numbers.
enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// The bytes of one number of that type in a binary body.
std::size_t byte_count(PlyType type);

constexpr bool is_integer(PlyType type) {
  return type != PlyType::Float32 && type != PlyType::Float64;
}

/// A property of an element: one number, or a list of numbers with its length before it.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> length_type;  ///< Of a list's length; nothing for a single number.
};

/// A table of the body: `count` rows of the properties.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of the property of that name, if there is one.
  std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;  ///< In the order of the body.
  std::size_t body_offset = 0;       ///< [bytes]
};

/// Reads the header. Each element is checked against what the rest of the file can hold, so that its count may be
/// trusted for reserving memory. Errors: Unreadable with the line.
Result<PlyHeader> parse_ply_header(const MeshSource& source);

}  // namespace dismantle
