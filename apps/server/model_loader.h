// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle::server {

/// Options for preparing assemblies for a session.
struct ModelOptions {
  ImportOptions import;
  ClassifyOptions classify;
  std::size_t simplify = 0;  ///< To about so many triangles; 0: as they are.
  Executor executor;
};

/// Reads an assembly and makes its model, all but the number. A file is parsed in a child process with limits on memory
/// and time: what crashes, hangs or lies there is an Error here. Errors: of load_assembly and classify_pairs; Failed
/// where `progress` cancelled.
Result<Model> load_model(const std::filesystem::path& file, const ModelOptions& options,
                         const ProgressCallback& progress);

}  // namespace dismantle::server
