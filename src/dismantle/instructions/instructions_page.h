// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/work_instructions.h"

#include <string>

namespace dismantle {

/// Work instructions as one HTML page (well-formed XML, too) for the screen and for paper, two steps or more a sheet.
/// It loads nothing from anywhere, has no script, and its own policy forbids both. Same input, same bytes.
std::string instructions_page(const WorkInstructions& instructions);

}  // namespace dismantle
