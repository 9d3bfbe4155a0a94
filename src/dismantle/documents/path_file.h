// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dismantle {

/// The largest path or motion file that is read [bytes]; in memory its values take about ten times as much.
constexpr std::size_t kLargestJsonFile = std::size_t{512} << 20;

/// Reads `*.path.json` (docs/formats.md). Checks everything that does not need the assembly: format and version,
/// numbers finite and sane, times from 0 and never decreasing, quaternions of unit length (within 1e-6; scaled to 1),
/// components of pairs and moves listed in the file. A `free` pair's allowance becomes infinite. Of a file of version 1
/// the pairs are checked and left out. `pairs`, `removed` and a move's `label` may be absent; members not described in
/// docs/formats.md are ignored. Errors: Unreadable, with the position ("moves[2].frames[5].rotation").
Result<Path> read_path(const std::filesystem::path& file);

/// As read_path, from text; `file_name` is for messages.
Result<Path> parse_path(std::string_view text, const std::string& file_name);

/// The path in the format of docs/formats.md, one frame a line; a path of version 1 in that version. Reading it back
/// gives an equal Path, doubles bit for bit.
/// @pre all numbers finite (except the allowance of a Free pair); no pairs in version 1; names in UTF-8
std::string path_text(const Path& path);

/// Writes path_text, whole or not at all. Errors: Failed.
Result<Done> write_path(const std::filesystem::path& file, const Path& path);

/// Checks that every component of the path is in the assembly. Errors: Unreadable, with the first that is not.
Result<Done> check_names(const Path& path, const Assembly& assembly);

}  // namespace dismantle
