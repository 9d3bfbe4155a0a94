// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace dismantle {

/// Escapes text for HTML content and quoted attributes. Control characters become spaces, invalid UTF-8 becomes U+FFFD.
/// The result cannot start a tag or end an attribute.
std::string html_escaped(std::string_view text);

/// Encodes bytes in base64 (RFC 4648).
std::string base64(Span<const std::uint8_t> bytes);

/// A data URL of a PNG file.
std::string png_data_url(Span<const std::uint8_t> png);

}  // namespace dismantle
