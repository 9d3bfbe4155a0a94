// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/engine/device_choice.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>

namespace dismantle::server {

/// Options for preparing assemblies for a session.
struct ModelOptions {
  ImportOptions import;                      ///< Of reading the file.
  ClassifyOptions classify;                  ///< Of the pair states.
  std::filesystem::path declared_for;        ///< The file to which `classify.declared` applies; empty: every file.
  std::size_t simplify = 0;                  ///< Approximate number of triangles to simplify to; 0: no simplification.
  bool drag_by_streams = false;              ///< Drags are computed by method `streams`.
  DeviceChoice device = DeviceChoice::Auto;  ///< Of method `streams`.
  Executor executor;                         ///< Of simplification and of the session's engine.
};

/// Loads an assembly and makes its model, without a number. Errors: of load_assembly, simplify_assembly,
/// classify_pairs and glb_from_assembly; Failed if `progress` cancels.
Result<Model> load_model(const std::filesystem::path& file, const ModelOptions& options,
                         const ProgressCallback& progress);

}  // namespace dismantle::server
