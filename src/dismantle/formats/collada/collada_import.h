// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <string>
#include <string_view>

namespace dismantle {

/// The library that reads COLLADA, and its version; empty if there is none.
std::string collada_reader();

/// Reads a COLLADA file with it, in this process; `name` is the file's, without its folder. Errors: Unreadable, "<why>;
/// <what to do>". Progress cannot cancel. @pre collada_reader() is not empty
Result<Assembly> import_collada(std::string_view bytes, const std::string& name, const ImportOptions& options);

}  // namespace dismantle
