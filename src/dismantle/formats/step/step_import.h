// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <string>
#include <string_view>

namespace dismantle {

/// Parses and meshes the text of a STEP file in this process, with OpenCASCADE; `name` (the file's stem) is for
/// components without a name. The result is that of read_step. Throws OpenCASCADE's exceptions and changes its global
/// settings: only for a dedicated process. Progress cannot cancel.
Result<Assembly> import_step(std::string_view text, const std::string& name, const ImportOptions& options);

}  // namespace dismantle
