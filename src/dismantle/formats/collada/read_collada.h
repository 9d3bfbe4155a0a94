// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstdint>
#include <filesystem>

namespace dismantle {

/// Memory limit of the process that parses a COLLADA file [bytes]: the base plus kColladaMemoryPerByte for each byte of
/// the file.
inline constexpr std::uint64_t kColladaMemoryBase = std::uint64_t{1} << 30;
/// See kColladaMemoryBase.
inline constexpr std::uint64_t kColladaMemoryPerByte = 200;
/// Processor time limit of that process [s].
inline constexpr double kColladaCpuSeconds = 3600;

/// Reads a COLLADA file through Assimp, in a child process within the limits above: one component for each node with a
/// mesh, with the node's name, world transform, and the diffuse colour of the largest part of its surface; the nodes as
/// tree. Coordinates are scaled from the file's unit, unless `options.units` overrides it; its axes are kept, whichever
/// is up. Errors: Unreadable, also where dismantle was built without Assimp; Failed if cancelled or if no process could
/// be started; Usage for unknown units.
Result<Assembly> read_collada(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
