// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <string_view>

namespace dismantle {

/// A file of the viewer's page that the program carries in itself.
struct WebFile {
  std::string_view path;          ///< As a request names it: "/index.html".
  std::string_view content_type;  ///< "text/html; charset=utf-8"
  std::string_view bytes;
};

/// All of them.
Span<const WebFile> web_files();

}  // namespace dismantle
