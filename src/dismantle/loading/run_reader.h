// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/imported_assembly.h"

#include <filesystem>
#include <functional>

namespace dismantle {

/// Reads a file in the calling process. Errors: as load_assembly(); it may throw std::bad_alloc and std::length_error.
using ModelReader =
    std::function<Result<ImportedAssembly>(const std::filesystem::path& file, const ImportOptions& options)>;

/// The main() of a reader program: serves the request of load_assembly(), confined to reading the model. Returns the
/// exit code.
int run_reader(const ModelReader& read);

}  // namespace dismantle
