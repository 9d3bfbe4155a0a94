// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/exported_file.h"
#include "dismantle/instructions/pdf_sheet.h"
#include "dismantle/instructions/work_instructions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dismantle {

/// The time that files state as that of their creation [s since 1970]: SOURCE_DATE_EPOCH, if it is set, so that the
/// same input gives the same bytes; else now.
std::int64_t creation_time();

/// Options of instructions_file().
struct InstructionsFileOptions {
  ExportFormat format = ExportFormat::InstructionsHtml;  ///< InstructionsHtml or InstructionsPdf.
  PaperSize paper = kPaperA4;                            ///< A4 or Letter.
  std::int64_t time = 0;                                 ///< Time of creation [s since 1970]; see creation_time().
  /// Of the content. A title block without a date gets that of `time`; `missing_glyphs` is set for the format.
  WorkInstructionsOptions content;
};

/// A file of work instructions.
struct InstructionsFile {
  std::string bytes;               ///< The HTML page or the PDF.
  std::vector<std::string> notes;  ///< For the user: what the file lacks, a sentence each.
};

/// Makes work instructions and writes them as a file. A note says which characters no font has.
/// @pre the timeline and the pairs belong to the assembly
/// Errors: of work_instructions() and instructions_pdf().
Result<InstructionsFile> instructions_file(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
                                           InstructionsFileOptions options);

}  // namespace dismantle
