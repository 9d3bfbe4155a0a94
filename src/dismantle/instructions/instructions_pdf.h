// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/instructions/work_instructions.h"

#include <string>

namespace dismantle {

/// Work instructions as a PDF for A4 paper: a cover with the parts list, then the steps, as many a page as there is
/// room for. Text is in the machine's sans-serif font, other scripts in whatever fonts it has for them. Same input and
/// fonts, same bytes. Errors: Failed where the PDF could not be made.
Result<std::string> instructions_pdf(const WorkInstructions& instructions);

}  // namespace dismantle
