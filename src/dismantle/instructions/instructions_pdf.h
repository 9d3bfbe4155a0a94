// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/instructions/pdf_sheet.h"
#include "dismantle/instructions/work_instructions.h"

#include <cstdint>
#include <string>

namespace dismantle {

/// Options of instructions_pdf().
struct InstructionsPdfOptions {
  PaperSize paper = kPaperA4;  ///< Of all pages.
  std::int64_t time = 0;       ///< Time of creation that the file states [s since 1970, UTC].
};

/// Work instructions as a PDF: a cover with the title block, an exploded overview with balloons, and the parts list;
/// then the steps, as many per page as fit, each picture with the axes. Uses the system's sans-serif font and its
/// fallback fonts, and embeds them. Deterministic for the same fonts. Errors: Failed if cairo reports an error.
Result<std::string> instructions_pdf(const WorkInstructions& instructions, const InstructionsPdfOptions& options = {});

}  // namespace dismantle
