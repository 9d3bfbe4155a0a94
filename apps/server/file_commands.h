// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/hub.h"
#include "apps/server/jobs.h"
#include "apps/server/model_loader.h"
#include "apps/server/recent_files.h"
#include "apps/server/roots.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace dismantle::server {

/// Removes a file and then its folder, if that is empty. Errors are ignored.
void remove_with_folder(const std::filesystem::path& file);

/// A file or a folder of meshes that is or was opened.
struct OpenedFile {
  std::filesystem::path path;              ///< Where it is.
  std::string name;                        ///< For users.
  std::filesystem::path temporary_folder;  ///< Removed with all that it holds at the end of this; empty: none.

  /// Of a file that exists, with its own name.
  explicit OpenedFile(std::filesystem::path file);
  /// Of a file in a folder from new_temporary_folder().
  OpenedFile(std::filesystem::path file, std::string display_name, std::filesystem::path folder)
      : path(std::move(file)), name(std::move(display_name)), temporary_folder(std::move(folder)) {}
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;
  ~OpenedFile();
};

/// The file commands of docs/wire.md: samples, files, recent, open, open_again, cancel. For the network's thread.
class FileCommands final : public ServerCommands {
 public:
  /// @param roots the folders that clients may read
  /// @param options for loading assemblies
  /// @param jobs runs the imports; must outlive this
  /// @param on_model receives each loaded model, on the job's thread
  FileCommands(Roots roots, ModelOptions options, RecentFiles recent, Jobs& jobs, std::function<void(Model)> on_model)
      : roots_(std::move(roots)),
        options_(std::move(options)),
        recent_(std::move(recent)),
        jobs_(jobs),
        on_model_(std::move(on_model)) {}

  bool knows(std::string_view command) const override;
  bool needs_control(std::string_view command) const override;
  Result<Json> execute(const Json& command) override;

  /// The folders that clients may read.
  const Roots& roots() const { return roots_; }
  /// Starts a job that loads a file, below a root or not. @return the job's number. Errors: Usage if a job is running.
  Result<std::uint32_t> open_file(const std::filesystem::path& file);
  /// As open_file(), and removes the file and its folder: where it cannot be loaded, when another file has been loaded,
  /// and at the end.
  Result<std::uint32_t> open_upload(const std::filesystem::path& file);
  /// As open_upload(), for several files that belong together, packed as docs/wire.md says. @param name of the folder
  /// that they are from; may be empty. Errors: also of unpack_files() and assembly_among().
  Result<std::uint32_t> open_packed(const std::filesystem::path& packed, const std::string& name);
  /// As open_file(), for a bundled sample. Errors: also Usage if there is no such sample, Failed if no temporary file
  /// can be written.
  Result<std::uint32_t> open_sample(const std::string& name);

 private:
  Result<Json> samples() const;
  Result<Json> files(const Json& command) const;
  Result<Json> recent() const;
  std::vector<std::filesystem::path> recent_in_roots() const;
  Result<Json> open(const Json& command);
  Result<Json> cancel(const Json& command);
  Result<Json> open_again(const Json& command);
  Result<std::uint32_t> start(std::shared_ptr<const OpenedFile> file, const std::string& units);
  /// Lets what a file refers to be where clients may read: below the roots, or among the files that were sent with it.
  void add_reference_folders(const OpenedFile& file, ImportOptions& options) const;

  Roots roots_;
  ModelOptions options_;
  RecentFiles recent_;
  Jobs& jobs_;
  std::function<void(Model)> on_model_;
  std::mutex mutex_;                          // of opened_, which jobs set
  std::shared_ptr<const OpenedFile> opened_;  // that of the present model; null: none
};

/// Creates a folder with a unique name in the system's folder for temporary files. Errors: Failed.
Result<std::filesystem::path> new_temporary_folder();

}  // namespace dismantle::server
