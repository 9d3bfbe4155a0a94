// SPDX-License-Identifier: Apache-2.0
#include "apps/server/static_files.h"

#include "apps/server/roots.h"
#include "dismantle/files/read_file.h"
#include "web/web_files.h"

#include <array>
#include <utility>

namespace dismantle::server {

namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
}};

std::string content_type_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const auto& [suffix, type] : kTypes)
    if (extension == suffix) return std::string(type);
  return "application/octet-stream";
}

std::optional<HttpResponse> from_folder(const std::filesystem::path& folder, const std::string& path) {
  const Result<Roots> root = Roots::create({folder});
  if (!root) return {};
  const Result<std::filesystem::path> file = root->find(0, path.substr(1));
  if (!file) return {};
  Result<std::string> bytes = read_file(*file, kMaxFileBytes);
  if (!bytes) return {};
  return HttpResponse{200, content_type_of(path), std::make_shared<const std::string>(std::move(*bytes)), {}};
}

}  // namespace

std::optional<HttpResponse> StaticFiles::find(const std::string& path) const {
  const std::string requested = path == "/" ? "/index.html" : path;
  if (folder_) return from_folder(*folder_, requested);
  for (const WebFile& file : web_files())
    if (file.path == requested)
      return HttpResponse{200, std::string(file.content_type), std::make_shared<const std::string>(file.bytes), {}};
  return {};
}

}  // namespace dismantle::server
