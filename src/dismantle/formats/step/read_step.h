// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <cstdint>
#include <filesystem>

namespace dismantle {

/// Default linear deflection, relative to the diagonal of the assembly's bounding box. One absolute value for the whole
/// assembly, as its tolerance follows from the coarsest component.
inline constexpr double kDefaultRelativeDeflection = 5e-5;
/// Default angular deflection [rad]: 20 degrees, 18 sides to a full turn. Refines small round features of large
/// assemblies.
inline constexpr double kDefaultAngularDeflection = 0.3490658503988659;

/// Memory limit of the process that parses and meshes a STEP file [bytes]: the base plus kStepMemoryPerByte for each
/// byte of the file.
inline constexpr std::uint64_t kStepMemoryBase = std::uint64_t{4} << 30;
/// See kStepMemoryBase; real files take 10 to 60.
inline constexpr std::uint64_t kStepMemoryPerByte = 200;
/// Processor time limit of all threads of that process [s].
inline constexpr double kStepCpuSeconds = 4 * 3600;
/// Limit of the time without any progress [s].
inline constexpr double kStepSilenceSeconds = 600;

/// Reads a STEP file (AP203, AP214, AP242) through OpenCASCADE's XDE: one component for each leaf solid occurrence of
/// the product tree, with the product's name, colour, placement and tree; instances share their mesh. A product without
/// solids gives one component of its faces. The file is parsed and meshed in a child process within the limits above,
/// so that a file that crashes the CAD kernel is an Error and not a crash; the child is a fork, so the calling program
/// must not have started OpenCASCADE's own thread pool (OSD_ThreadPool). `options.units` replaces the file's first
/// length unit: all lengths scale by their ratio. Errors: Unreadable; Failed if cancelled or if no process could be
/// started; Usage for unknown units.
Result<Assembly> read_step(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
