// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"
#include "dismantle/core/span.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace dismantle {

/// The content of a `.dasm` file: dismantle's own binary format (docs/formats.md), which needs no library to be read.
struct AssemblyFile {
  Assembly assembly;             ///< Meshes shared as they were written.
  std::optional<Motion> motion;  ///< A motion of its components.
};

/// The bytes of a `.dasm` file, little-endian on every machine that dismantle is built for. Everything is kept exactly.
/// @param motion may be null
std::string assembly_file_bytes(const Assembly& assembly, const Motion* motion = nullptr);

/// Parses the bytes of a `.dasm` file. Every count, index, number and rotation is checked; meshes are taken as they
/// are. Errors: Unreadable. @param file_name for messages
Result<AssemblyFile> parse_assembly_file(Span<const std::byte> bytes, const std::string& file_name);

/// Reads a `.dasm` file. Errors: Unreadable, also for a file that is missing or larger than `limit_bytes`.
Result<AssemblyFile> read_assembly_file(const std::filesystem::path& file,
                                        std::uint64_t limit_bytes = std::uint64_t{4} << 30);

}  // namespace dismantle
