// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <string_view>

namespace dismantle {

/// A file of the viewer page, embedded in the program.
struct WebFile {
  std::string_view path;          ///< Path in requests, such as "/index.html".
  std::string_view content_type;  ///< HTTP content type, such as "text/html; charset=utf-8".
  std::string_view bytes;         ///< Content of the file.
};

/// All embedded files.
Span<const WebFile> web_files();

}  // namespace dismantle
