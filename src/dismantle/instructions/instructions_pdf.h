// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/instructions/work_instructions.h"

#include <string>

namespace dismantle {

/// Work instructions as a PDF for A4 paper: a cover with the parts list, then the steps, as many per page as fit. Uses
/// the system's sans-serif font and its fallback fonts. Deterministic for the same fonts. Errors: Failed if cairo
/// reports an error.
Result<std::string> instructions_pdf(const WorkInstructions& instructions);

}  // namespace dismantle
