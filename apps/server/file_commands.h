// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/hub.h"
#include "apps/server/jobs.h"
#include "apps/server/model_loader.h"
#include "apps/server/recent_files.h"
#include "apps/server/roots.h"
#include "apps/server/upload_store.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace dismantle::server {

/// A file or a folder of meshes that is or was opened.
struct OpenedFile {
  std::filesystem::path path;            ///< Where it is.
  std::string name;                      ///< For users.
  std::shared_ptr<UploadFolder> folder;  ///< Holds the file; null: the file is not an upload.
};

/// Unpacks several files that belong together, packed as docs/wire.md says, into a folder. For any thread.
/// @param packed a file in the folder
/// @param name of the folder that they are from; may be empty
/// @return what to open. Errors: as unpack_files() and assembly_among()
Result<OpenedFile> unpack_upload(const std::filesystem::path& packed, const std::string& name,
                                 std::shared_ptr<UploadFolder> folder);

/// The file commands of docs/wire.md: samples, files, recent, open, open_again, cancel. For the network's thread.
class FileCommands final : public ServerCommands {
 public:
  /// @param roots the folders that clients may read
  /// @param options for loading assemblies
  /// @param jobs runs the imports; must outlive this
  /// @param uploads keeps bundled samples while they are open; must outlive this
  /// @param on_model receives each loaded model, on the job's thread
  FileCommands(Roots roots, ModelOptions options, RecentFiles recent, Jobs& jobs, UploadStore& uploads,
               std::function<void(Model)> on_model)
      : roots_(std::move(roots)),
        options_(std::move(options)),
        recent_(std::move(recent)),
        jobs_(jobs),
        uploads_(uploads),
        on_model_(std::move(on_model)) {}

  bool knows(std::string_view command) const override;
  bool needs_control(std::string_view command) const override;
  Result<Json> execute(const Json& command) override;

  /// The folders that clients may read.
  const Roots& roots() const { return roots_; }
  /// Starts a job that loads a file, below a root or not. @return the job's number. Errors: Usage if a job is running.
  Result<std::uint32_t> open_file(const std::filesystem::path& file);
  /// As open_file(), and keeps the folder of the file until the file cannot be loaded, another file has been loaded, or
  /// the end.
  Result<std::uint32_t> open_upload(const std::filesystem::path& file, std::shared_ptr<UploadFolder> folder);
  /// As open_upload(), for files from unpack_upload().
  Result<std::uint32_t> open_unpacked(OpenedFile file);
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
  UploadStore& uploads_;
  std::function<void(Model)> on_model_;
  std::mutex mutex_;                          // of opened_, which jobs set
  std::shared_ptr<const OpenedFile> opened_;  // that of the present model; null: none
};

}  // namespace dismantle::server
