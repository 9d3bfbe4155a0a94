// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/cli/command.h"
#include "dismantle/export/exported_file.h"
#include "dismantle/export/path_animations.h"
#include "dismantle/instructions/work_instructions.h"

#include <string>

namespace dismantle::cli {

/// The paper of work instructions.
enum class Paper { A4, Letter };

/// The options of work instructions.
struct InstructionsCommand {
  std::string product;  ///< For the title; empty: the file's name.
  Paper paper = Paper::A4;
  TitleBlock title_block;  ///< Without a date: today.

  /// The first option that was given; empty if there is none.
  std::string given() const;
};

/// Declares --product, --paper, --document-number, --revision, --author and --date.
void add_instructions_options(CLI::App& command, InstructionsCommand& options);

/// The work instructions of a path, as a page or a PDF. Prints a note on stderr where the PDF lacks glyphs of names.
/// Errors: of instructions_file().
Result<std::string> instructions_text(const Assembly& assembly, const Timeline& timeline, PathDirection direction,
                                      const std::string& product, ExportFormat format,
                                      const InstructionsCommand& command, const CommonOptions& common);

}  // namespace dismantle::cli
