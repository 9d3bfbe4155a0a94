// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstdint>
#include <filesystem>

namespace dismantle {

/// The linear deflection where the user gives none, relative to the diagonal of the assembly's box. One absolute value
/// for the whole assembly, because its tolerance follows from the coarsest component.
inline constexpr double kDefaultRelativeDeflection = 5e-5;
/// The angular deflection where the user gives none [rad]: 20 degrees, 18 sides to a full turn. It is what refines
/// small round features of large assemblies.
inline constexpr double kDefaultAngularDeflection = 0.3490658503988659;

/// What the process that parses and meshes a STEP file may use: memory [bytes] is this much, and this much for each
/// byte of the file (real files take 10 to 60); computing time [s] of all its threads; time [s] without any progress.
inline constexpr std::uint64_t kStepMemoryBase = std::uint64_t{4} << 30;
inline constexpr std::uint64_t kStepMemoryPerByte = 200;
inline constexpr double kStepCpuSeconds = 4 * 3600;
inline constexpr double kStepSilenceSeconds = 600;

/// Reads a STEP file (AP203, AP214, AP242) through OpenCASCADE's XDE: one component a leaf solid occurrence of the
/// product tree, with the product's name, colour, placement and tree; instances share their mesh. A product without
/// solids gives one component of its faces. The file is parsed and meshed in a child process within the limits above,
/// so that a file that crashes the CAD kernel is an Error and not a crash; the child is a fork, so the calling program
/// must not have started OpenCASCADE's own thread pool (OSD_ThreadPool). `options.units` replaces the file's first
/// length unit: all lengths scale by their ratio. Errors: Unreadable; Failed where it was cancelled or the system gave
/// no process; Usage for unknown units.
Result<Assembly> read_step(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
