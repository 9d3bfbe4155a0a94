// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/site.h"

#include <filesystem>
#include <optional>

namespace dismantle::server {

/// The files of the page: those embedded in the program, or those of a folder, for work on the page.
class StaticFiles {
 public:
  /// Without a folder, the embedded files.
  explicit StaticFiles(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// The response with the file of a path; "/" is "/index.html". None if there is no such file.
  std::optional<HttpResponse> find(const std::string& path) const;

 private:
  std::optional<std::filesystem::path> folder_;
};

}  // namespace dismantle::server
