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

/// Encoding of the body of a PLY file.
enum class PlyFormat { Ascii, BinaryLittleEndian, BinaryBigEndian };

/// Number types.
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// The size of a number of that type in a binary body [bytes].
std::size_t byte_count(PlyType type);

/// True for the integer types.
constexpr bool is_integer(PlyType type) {
  return type != PlyType::Float32 && type != PlyType::Float64;
}

/// A property of an element: one number, or a list of numbers with its length before it.
struct PlyProperty {
  std::string name;                    ///< As in the header.
  PlyType type = PlyType::Float32;     ///< Of the number, or of the items of the list.
  std::optional<PlyType> length_type;  ///< Of a list's length; none for a single number.
};

/// A table of the body: `count` rows of the properties.
struct PlyElement {
  std::string name;                     ///< As in the header: "vertex", "face", ...
  std::uint64_t count = 0;              ///< Number of rows.
  std::vector<PlyProperty> properties;  ///< Columns, in order.

  /// The index of the property of that name, if there is one.
  std::optional<std::size_t> find(std::string_view property) const;
};

/// The header of a PLY file.
struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;  ///< Encoding of the body.
  std::vector<PlyElement> elements;     ///< In the order of the body.
  std::size_t body_offset = 0;          ///< [bytes]
};

/// Reads the header. Each element's count is checked against the size of the rest of the file, so that it is safe to
/// reserve memory for it. Errors: Unreadable with the line.
Result<PlyHeader> parse_ply_header(const MeshSource& source);

}  // namespace dismantle
