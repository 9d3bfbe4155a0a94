// SPDX-License-Identifier: Apache-2.0
#include "apps/server/viewer_files.h"

#include "web/web_files.h"

namespace dismantle::server {

namespace {

std::string_view bytes_of(std::string_view path) {
  for (const WebFile& file : web_files())
    if (file.path == path) return file.bytes;
  DISMANTLE_ENSURE(false);  // web/CMakeLists.txt names them
  return {};
}

}  // namespace

ViewerFiles viewer_files() {
  return {bytes_of("/viewer.js"), bytes_of("/style.css"), bytes_of("/offline.css"), bytes_of("/icon.svg")};
}

}  // namespace dismantle::server
