// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <string>
#include <string_view>

namespace dismantle {

/// Parses and meshes the text of a STEP file in this process, with OpenCASCADE; `name` (the file's stem) names what has
/// no name. What read_step says of its result holds. Throws what OpenCASCADE throws, leaves its settings changed and
/// its console output on: only for a process of its own. Progress cannot cancel.
Result<Assembly> import_step(std::string_view text, const std::string& name, const ImportOptions& options);

}  // namespace dismantle
