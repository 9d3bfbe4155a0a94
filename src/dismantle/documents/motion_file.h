// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dismantle {

/// Reads `*.motion.json` (docs/formats.md). Checks everything that does not need the assembly: format and version, the
/// response's name (absent: slide), numbers finite and sane, times from 0 and never decreasing, quaternions of unit
/// length (within 1e-6; scaled to 1). Members not described in docs/formats.md are ignored. Errors: Unreadable, with
/// the position
/// ("moves[2].targets[5].rotation").
Result<Motion> read_motion(const std::filesystem::path& file);

/// As read_motion, from text; `file_name` is for messages.
Result<Motion> parse_motion(std::string_view text, const std::string& file_name);

/// The motion in the format of docs/formats.md, one target a line. Reading it back gives an equal Motion, doubles bit
/// for bit.
/// @pre all numbers finite; names in UTF-8
std::string motion_text(const Motion& motion);

/// Writes motion_text, whole or not at all. Errors: Failed.
Result<Done> write_motion(const std::filesystem::path& file, const Motion& motion);

/// Checks that every component of the motion is in the assembly. Errors: Unreadable, with the first that is not and its
/// position.
Result<Done> check_names(const Motion& motion, const Assembly& assembly);

}  // namespace dismantle
