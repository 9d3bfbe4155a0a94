// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/import/import_options.h"

namespace dismantle {

/// Meshes the shapes of a model, and makes a component of each occurrence; occurrences of a shape share their mesh.
/// `options.units` replaces the file's unit: all lengths scale by their ratio. Throws OpenCASCADE's exceptions. Errors:
/// Unreadable, with a message "<why>; <what to do>", if a limit is exceeded or there is no component. Progress cannot
/// cancel.
Result<Assembly> assembly_from_cad(CadModel model, const ImportOptions& options);

}  // namespace dismantle
