// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace dismantle {

/// The name as valid UTF-8 without control characters (C0, DEL, C1), so that it can stand in JSON, on a terminal and in
/// a line of text: text that is no UTF-8 is taken as Latin-1, control characters become '_'. A clean name stays as it
/// is.
std::string clean_name(std::string_view name);

/// The name as a file's stem: as clean_name, without '/', not beginning with '.', at most 200 bytes, never empty.
std::string file_stem(std::string_view name);

/// Up to 40 characters of `text` in quotes, unprintable ones as "?": for messages.
std::string in_quotes(std::string_view text);

}  // namespace dismantle
