// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"

#include <filesystem>

namespace dismantle {

/// Default linear deflection, relative to the diagonal of the assembly's bounding box. One absolute value for the whole
/// assembly, as its tolerance follows from the coarsest component.
inline constexpr double kDefaultRelativeDeflection = 5e-5;
/// Default angular deflection [rad]: 20 degrees, 18 sides to a full turn. Refines small round features of large
/// assemblies.
inline constexpr double kDefaultAngularDeflection = 0.3490658503988659;

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
/// `options.units` replaces the file's first length unit: all lengths scale by their ratio. OpenCASCADE is used in this
/// process, with its own threads, and may crash on hostile files: for a process of its own; load_assembly() starts one.
/// Errors: Unreadable; Usage for unknown units.
/// @pre is_cad_file(file)
Result<ImportedAssembly> read_cad(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace dismantle
