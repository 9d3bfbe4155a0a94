// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dismantle {

/// Reads `*.motion.json` (docs/formats.md). Everything is checked that needs no assembly: format and version, the
/// response's name (absent: slide), numbers finite and sane, times from 0 on and never decreasing, quaternions of unit
/// length (within 1e-6; scaled to 1). Members that docs/formats.md does not name are passed over. Errors: Unreadable,
/// naming the place like "moves[2].targets[5].rotation".
Result<Motion> read_motion(const std::filesystem::path& file);

/// As read_motion, from text; `file_name` is for messages.
Result<Motion> parse_motion(std::string_view text, const std::string& file_name);

/// The motion as docs/formats.md has it, a target a line. Reading it back gives an equal Motion, doubles bit for bit.
/// @pre all numbers finite; names in UTF-8
std::string motion_text(const Motion& motion);

/// Writes motion_text, whole or not at all. Errors: Failed.
Result<Done> write_motion(const std::filesystem::path& file, const Motion& motion);

/// That every component that the motion names is in the assembly. Errors: Unreadable, naming the first that is not and
/// its place.
Result<Done> check_names(const Motion& motion, const Assembly& assembly);

}  // namespace dismantle
