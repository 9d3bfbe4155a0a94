// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/instructions.h"

#include "apps/cli/option_checks.h"
#include "dismantle/instructions/instructions_file.h"

#include <cstdio>
#include <map>

namespace dismantle::cli {

std::string InstructionsCommand::given() const {
  for (const auto& [option, is_given] :
       {std::pair("--product", !product.empty()), std::pair("--paper", paper != Paper::A4),
        std::pair("--document-number", !title_block.number.empty()),
        std::pair("--revision", !title_block.revision.empty()), std::pair("--author", !title_block.author.empty()),
        std::pair("--date", !title_block.date.empty())})
    if (is_given) return option;
  return {};
}

void add_instructions_options(CLI::App& command, InstructionsCommand& options) {
  static const std::map<std::string, Paper> kPapers{{"a4", Paper::A4}, {"letter", Paper::Letter}};
  const std::string group = "Work instructions";
  command.add_option("--product", options.product, "Name of the product (default: from the file)")
      ->type_name("NAME")
      ->group(group);
  command.add_option("--paper", options.paper, "Paper size (default: a4)")
      ->transform(choice(kPapers))
      ->type_name("a4|letter")
      ->group(group);
  command.add_option("--document-number", options.title_block.number, "Title block: number of the document")
      ->type_name("TEXT")
      ->group(group);
  command.add_option("--revision", options.title_block.revision, "Title block: revision")
      ->type_name("TEXT")
      ->group(group);
  command.add_option("--author", options.title_block.author, "Title block: author")->type_name("NAME")->group(group);
  command.add_option("--date", options.title_block.date, "Title block: date (default: today)")
      ->type_name("TEXT")
      ->group(group);
}

Result<std::string> instructions_text(const Assembly& assembly, const Timeline& timeline, PathDirection direction,
                                      const std::string& product, ExportFormat format,
                                      const InstructionsCommand& command, const CommonOptions& common) {
  const Result<PairStates> states = classify(assembly, common);
  if (!states) return states.error();
  InstructionsFileOptions options;
  options.format = format;
  options.paper = command.paper == Paper::Letter ? kPaperLetter : kPaperA4;
  options.time = creation_time();
  options.content.direction = direction;
  options.content.product = product;
  options.content.title_block = command.title_block;
  options.content.engine = {make_executor(common), widest_lanes()};
  options.content.progress = progress_printer(common);
  Result<InstructionsFile> file = instructions_file(assembly, *states, timeline, options);
  if (!file) return file.error();
  for (const std::string& note : file->notes) std::fprintf(stderr, "dismantle: note: %s\n", note.c_str());
  return std::move(file->bytes);
}

}  // namespace dismantle::cli
