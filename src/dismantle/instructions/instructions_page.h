// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/instructions/pdf_sheet.h"
#include "dismantle/instructions/work_instructions.h"

#include <string>

namespace dismantle {

/// Work instructions as a self-contained HTML page for screen and print, which is also well-formed XML. Has no scripts;
/// its content security policy forbids them and loading anything. Deterministic.
/// @param paper for printing: A4 or Letter
std::string instructions_page(const WorkInstructions& instructions, const PaperSize& paper = kPaperA4);

}  // namespace dismantle
