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

/// Memory limit of the process that parses and meshes a CAD file [bytes]: the base plus kCadMemoryPerByte for each byte
/// of the file.
inline constexpr std::uint64_t kCadMemoryBase = std::uint64_t{4} << 30;
/// See kCadMemoryBase; real files take 10 to 60.
inline constexpr std::uint64_t kCadMemoryPerByte = 200;
/// Processor time limit of all threads of that process [s].
inline constexpr double kCadCpuSeconds = 4 * 3600;
/// Limit of the time without any progress [s].
inline constexpr double kCadSilenceSeconds = 600;

/// True if the extension is that of a CAD file, in upper or lower case: .step, .stp, .iges, .igs, .brep, .brp,
/// .fcstd.
bool is_cad_file(const std::filesystem::path& file);

/// Reads a CAD file through OpenCASCADE: one component for each solid of each product's occurrences, with the product's
/// name, colour, placement and tree; instances share their mesh.
/// - STEP (AP203, AP214, AP242): the product tree; a product's faces outside solids are one component.
/// - IGES: entities and groups; faces that meet are sewn together, and closed shells become solids.
/// - BREP, text or binary: each solid, and each shell outside solids.
/// - FCStd: what is visible in a FreeCAD document and not made into another feature, with labels and placements; links
///   and arrays as occurrences, parts and groups as tree. Documents that it links to are read, too.
/// The file is parsed and meshed in a child process within the limits above, so that a file that crashes the CAD kernel
/// is an Error and not a crash; the child is a fork, so the calling program must not have started OpenCASCADE's own
/// thread pool (OSD_ThreadPool). `options.units` replaces the file's first length unit: all lengths scale by their
/// ratio. Errors: Unreadable; Failed if cancelled or if no process could be started; Usage for unknown units.
/// @pre is_cad_file(file)
Result<Assembly> read_cad(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
