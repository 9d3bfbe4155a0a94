// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"

#include <filesystem>

namespace dismantle {

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
