// SPDX-License-Identifier: Apache-2.0
#include "apps/server/recent_files.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/read_file.h"

#include <nlohmann/json.hpp>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxRecent = 20;
constexpr std::size_t kMaxListBytes = 1 << 20;

}  // namespace

std::vector<fs::path> RecentFiles::list() const {
  std::vector<fs::path> files;
  if (file_.empty()) return files;
  const Result<std::string> text = read_file(file_, kMaxListBytes);
  if (!text) return files;
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_array()) return files;
  std::error_code error;
  for (const nlohmann::json& one : json)
    if (one.is_string() && fs::exists(one.get<std::string>(), error)) files.emplace_back(one.get<std::string>());
  return files;
}

void RecentFiles::add(const fs::path& opened) const {
  if (file_.empty()) return;
  std::error_code error;
  const fs::path real = fs::canonical(opened, error);
  if (error) return;
  std::vector<fs::path> files = list();
  std::erase(files, real);
  files.insert(files.begin(), real);
  files.resize(std::min(files.size(), kMaxRecent));
  nlohmann::json json = nlohmann::json::array();
  for (const fs::path& file : files) json.push_back(file.string());
  fs::create_directories(file_.parent_path(), error);
  [[maybe_unused]] const Result<Done> written =
      write_file(file_, json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace dismantle::server
