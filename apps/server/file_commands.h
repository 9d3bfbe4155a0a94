// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/hub.h"
#include "apps/server/jobs.h"
#include "apps/server/model_loader.h"
#include "apps/server/recent_files.h"
#include "apps/server/roots.h"

#include <filesystem>
#include <functional>

namespace dismantle::server {

/// The commands of docs/wire.md that are about files: samples, files, recent, open, cancel.
class FileCommands final : public ServerCommands {
 public:
  /// @param jobs must outlive this; `on_model` is called on a job's thread
  FileCommands(Roots roots, ModelOptions options, RecentFiles recent, Jobs& jobs, std::function<void(Model)> on_model)
      : roots_(std::move(roots)),
        options_(std::move(options)),
        recent_(std::move(recent)),
        jobs_(jobs),
        on_model_(std::move(on_model)) {}

  bool knows(std::string_view command) const override;
  bool is_question(std::string_view command) const override;
  Result<Json> execute(const Json& command) override;

  const Roots& roots() const { return roots_; }
  /// Opens a file that need not be below a root. @return the job's number. Errors: Usage where one is being opened.
  Result<std::uint32_t> open_file(const std::filesystem::path& file);
  /// As open_file(), and removes the file and its folder afterwards.
  Result<std::uint32_t> open_upload(const std::filesystem::path& file);
  /// Errors: also Usage where there is no such sample.
  Result<std::uint32_t> open_sample(const std::string& name);

 private:
  Result<Json> samples() const;
  Result<Json> files(const Json& command) const;
  Result<Json> recent() const;
  std::vector<std::filesystem::path> recent_in_roots() const;
  Result<Json> open(const Json& command);
  Result<Json> cancel(const Json& command);
  Result<Jobs::Finish> load(const std::filesystem::path& file, const ProgressCallback& progress) const;

  Roots roots_;
  ModelOptions options_;
  RecentFiles recent_;
  Jobs& jobs_;
  std::function<void(Model)> on_model_;
};

/// Removes an upload and the folder that was made for it.
void remove_with_folder(const std::filesystem::path& file);

/// A new folder of our own in the system's folder for temporary files. Errors: Failed.
Result<std::filesystem::path> new_temporary_folder();

}  // namespace dismantle::server
