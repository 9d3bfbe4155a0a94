// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <string>
#include <string_view>

namespace dismantle {

/// Reads a COLLADA file with it, in this process; `name` is the file's, without its folder. Errors: Unreadable, "<why>;
/// <what to do>".
Result<Assembly> import_collada(std::string_view bytes, const std::string& name, const ImportOptions& options);

}  // namespace dismantle
