// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstdint>
#include <filesystem>

namespace dismantle {

/// What the process that parses a file of meshes may use: memory [bytes] is this much, and this much for each byte of
/// the file; computing time [s].
inline constexpr std::uint64_t kMeshMemoryBase = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMeshMemoryPerByte = 100;
inline constexpr double kMeshCpuSeconds = 3600;

/// As load_assembly, but every format is parsed in a child process (read_step.h has the limits for STEP): a file that
/// crashes or starves a reader is an Error and not the end of a program that has other work. Errors: as load_assembly.
Result<Assembly> load_isolated(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace dismantle
