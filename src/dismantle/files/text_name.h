// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace dismantle {

/// The name as valid UTF-8 without control characters (C0, DEL, C1), safe in JSON, on a terminal and within a line of
/// text. Text that is not UTF-8 is read as Latin-1; control characters become '_'. A clean name is unchanged.
std::string clean_name(std::string_view name);

/// The name as a file's stem: clean_name, without '/', not starting with '.', at most 200 bytes, never empty.
std::string file_stem(std::string_view name);

/// The first 40 bytes of `text` in quotes, for messages; bytes that are not printable ASCII become "?".
std::string in_quotes(std::string_view text);

}  // namespace dismantle
