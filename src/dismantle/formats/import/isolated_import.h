// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/files/isolated_process.h"
#include "dismantle/formats/import/import_options.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// A file that another file refers to, as it was read.
struct LinkedFile {
  std::filesystem::path file;  ///< Absolute.
  std::string sha256;          ///< Of its bytes.
};

/// What an importer made of a file.
struct ImportedAssembly {
  Assembly assembly;                     ///< Its source_file and source_sha256 need not be set.
  std::vector<LinkedFile> linked_files;  ///< Files that were read besides it.
};

/// An importer that runs in a child process, and what it needs.
struct IsolatedImport {
  std::string format;      ///< "STEP": for messages.
  std::string reader;      ///< What crashes or takes too long: "the CAD kernel".
  std::string version;     ///< All that the result depends on besides the file, its name and the options.
  IsolationLimits limits;  ///< Of the child process.
  /// Runs in the child, with a progress callback that does not cancel. An Error's message is "<why>; <what to do>".
  std::function<Result<ImportedAssembly>(const ImportOptions&)> import;
};

/// The Error for a file that cannot be read as `format`.
Error unreadable_as(const std::filesystem::path& file, std::string_view format, std::string_view why,
                    std::string_view advice);

/// Imports a file of these bytes in a child process, or takes the result of an earlier import out of
/// `options.cache_folder` if neither the bytes nor any linked file have changed. Sets source_file and source_sha256 (of
/// the bytes, and of the linked files if there are any). Errors: Unreadable; Failed if cancelled or if no process could
/// be started.
Result<Assembly> import_isolated(const std::filesystem::path& file, std::string_view bytes,
                                 const IsolatedImport& importer, const ImportOptions& options);

}  // namespace dismantle
