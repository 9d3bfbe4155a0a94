// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/cad/product_tree.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"
#include "dismantle/formats/import/units.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// A CAD file as OpenCASCADE reads it, not meshed.
struct CadModel {
  CadProductTree products;               ///< Shapes and placements [mm].
  LengthUnit unit;                       ///< Of the file.
  std::vector<LinkedFile> linked_files;  ///< Read besides it.
};

/// The file that a CAD model is read from.
struct CadSource {
  std::string_view bytes;  ///< The whole file.
  std::filesystem::path file;

  /// For components without a name: the file's stem.
  std::string name() const { return file.stem().string(); }
};

// The readers. Each runs in the calling process, throws OpenCASCADE's exceptions and changes its global settings: only
// for a dedicated process. Errors: Unreadable, with a message "<why>; <what to do>". Progress cannot cancel.

/// STEP (AP203, AP214, AP242): the product tree, with names, colours and placements.
Result<CadModel> read_step_model(const CadSource& source, const ImportOptions& options);
/// IGES: a product of each group of entities that has no groups in it, with names and colours. Its faces outside solids
/// are sewn together where they meet; closed shells become solids.
Result<CadModel> read_iges_model(const CadSource& source, const ImportOptions& options);
/// FCStd: the visible objects of a FreeCAD document, their labels, placements and colours, and those of the documents
/// that it links to.
Result<CadModel> read_freecad_model(const CadSource& source, const ImportOptions& options);
/// BREP, text or binary: a product of each compound that has no compounds in it.
Result<CadModel> read_brep_model(const CadSource& source, const ImportOptions& options);

}  // namespace dismantle
