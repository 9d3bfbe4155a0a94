// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dismantle {

/// Larger path and motion files are refused [bytes]: as values they take some ten times as much memory.
constexpr std::size_t kLargestJsonFile = std::size_t{512} << 20;

/// Reads `*.path.json` (docs/formats.md). Everything is checked that needs no assembly: format and version, numbers
/// finite and sane, times from 0 on and never decreasing, quaternions of unit length (within 1e-6; scaled to 1), pairs
/// and moves that name components of the file's own list. An `embedded` pair's allowance becomes infinite. `pairs`,
/// `removed` and a move's `label` may be absent; members that docs/formats.md does not name are passed over. Errors:
/// Unreadable, naming the place like "moves[2].frames[5].rotation".
Result<Path> read_path(const std::filesystem::path& file);

/// As read_path, from text; `file_name` is for messages.
Result<Path> parse_path(std::string_view text, const std::string& file_name);

/// The path as docs/formats.md has it, a frame a line. Reading it back gives an equal Path, doubles bit for bit.
/// @pre all numbers finite (but an Embedded pair's allowance); names in UTF-8
std::string path_text(const Path& path);

/// Writes path_text, whole or not at all. Errors: Failed.
Result<Done> write_path(const std::filesystem::path& file, const Path& path);

/// That every component that the path names is in the assembly. Errors: Unreadable, naming the first that is not.
Result<Done> check_names(const Path& path, const Assembly& assembly);

}  // namespace dismantle
