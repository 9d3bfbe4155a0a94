// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace dismantle {

/// `text` for HTML's content and quoted attributes: what has a meaning there is escaped, control characters become
/// spaces, bytes that are not UTF-8 become U+FFFD. Nothing in it can start a tag or end an attribute.
std::string html_escaped(std::string_view text);

/// Bytes in base64 (RFC 4648).
std::string base64(Span<const std::uint8_t> bytes);

/// PNG bytes as a URL that holds the picture itself.
std::string png_data_url(Span<const std::uint8_t> png);

}  // namespace dismantle
