// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstdint>
#include <filesystem>

namespace dismantle {

/// Memory limit of the process that parses a mesh file [bytes]: the base plus kMeshMemoryPerByte for each byte of the
/// file.
inline constexpr std::uint64_t kMeshMemoryBase = std::uint64_t{1} << 30;
/// See kMeshMemoryBase.
inline constexpr std::uint64_t kMeshMemoryPerByte = 100;
/// Processor time limit of that process [s].
inline constexpr double kMeshCpuSeconds = 3600;

/// Reads an assembly as load_assembly does, but parses every format in a child process (read_cad.h has the limits for
/// CAD files): a file that crashes a reader or exhausts memory gives an Error and does not end the calling program.
/// Errors: as load_assembly.
Result<Assembly> load_isolated(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace dismantle
