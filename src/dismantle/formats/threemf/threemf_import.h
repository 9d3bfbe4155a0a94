// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <functional>
#include <string>

namespace dismantle {

/// The bytes of a part of a package by its name, which has no slash in front. Errors: "<why>; <what to do>".
using ThreeMfPartLoader = std::function<Result<std::string>(const std::string& part)>;

/// Reads a 3MF package from its parts: read_3mf without file access and the hash. `name` is the file's name without its
/// folder.
Result<Assembly> import_3mf(const std::string& name, const ThreeMfPartLoader& load, const ImportOptions& options);

}  // namespace dismantle
