// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/instructions.h"

#include "apps/cli/option_checks.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/instructions/font_coverage.h"
#include "dismantle/instructions/instructions_page.h"
#include "dismantle/instructions/instructions_pdf.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

namespace dismantle::cli {

namespace {

/// The time that files state as that of their creation [s since 1970]: SOURCE_DATE_EPOCH, if it is set, so that the
/// same input gives the same bytes; else now.
std::int64_t creation_time() {
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"))
    if (const std::optional<std::int64_t> seconds = to_integer(epoch); seconds && *seconds >= 0) return *seconds;
  return std::time(nullptr);
}

std::string date_text(std::int64_t time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm local{};
  std::getenv("SOURCE_DATE_EPOCH") ? gmtime_r(&seconds, &local) : localtime_r(&seconds, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

/// Notes that no font has some characters. @param consequence what is printed instead
void note_missing(const std::string& characters, const char* consequence) {
  if (!characters.empty())
    std::fprintf(stderr,
                 "dismantle: note: no font has the characters %s %s; install fonts-noto-cjk or another font that has "
                 "them\n",
                 characters.c_str(), consequence);
}

}  // namespace

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

Result<std::string> instructions_file(const Assembly& assembly, const Timeline& timeline, PathDirection direction,
                                      const std::string& product, ExportFormat format,
                                      const InstructionsCommand& command, const CommonOptions& common) {
  const Result<PairStates> states = classify(assembly, common);
  if (!states) return states.error();
  const std::int64_t time = creation_time();
  const PaperSize paper = command.paper == Paper::Letter ? kPaperLetter : kPaperA4;
  WorkInstructionsOptions options;
  options.direction = direction;
  options.product = product;
  options.title_block = command.title_block;
  if (options.title_block.date.empty()) options.title_block.date = date_text(time);
  options.engine = {make_executor(common), widest_lanes()};
  options.progress = progress_printer(common);
  const FontCoverage fonts;
  const bool is_pdf = format == ExportFormat::InstructionsPdf;
  if (is_pdf) options.missing_glyphs = [&fonts](const std::string& name) { return fonts.missing(name); };
  const Result<WorkInstructions> made = work_instructions(assembly, *states, timeline, options);
  if (!made) return made.error();
  if (!is_pdf) return instructions_page(*made, paper);
  note_missing(made->missing_glyphs, "of component names, whose item numbers are printed instead");
  std::string cover = made->title;
  for (const auto& [heading, text] : title_block_entries(made->title_block)) cover += text;
  note_missing(fonts.missing(cover), "of the cover, in whose place a replacement character is printed");
  return instructions_pdf(*made, {paper, time});
}

}  // namespace dismantle::cli
