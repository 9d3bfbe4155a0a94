// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/site.h"

#include <filesystem>
#include <optional>

namespace dismantle::server {

/// The page's files: those in the program, or those of a folder for work on the page.
class StaticFiles {
 public:
  explicit StaticFiles(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// The file of a request's path; "/" is "/index.html". None where there is no such file.
  std::optional<HttpAnswer> find(const std::string& path) const;

 private:
  std::optional<std::filesystem::path> folder_;
};

}  // namespace dismantle::server
