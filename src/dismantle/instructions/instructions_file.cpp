// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_file.h"

#include "dismantle/files/text_scan.h"
#include "dismantle/instructions/font_coverage.h"
#include "dismantle/instructions/instructions_page.h"
#include "dismantle/instructions/instructions_pdf.h"

#include <cstdlib>
#include <ctime>
#include <utility>

namespace dismantle {

namespace {

std::string date_text(std::int64_t time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm local{};
  std::getenv("SOURCE_DATE_EPOCH") ? gmtime_r(&seconds, &local) : localtime_r(&seconds, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

/// Notes that no font has some characters. @param consequence what is printed instead
void note_missing(const std::string& characters, const char* consequence, std::vector<std::string>& notes) {
  if (!characters.empty())
    notes.push_back("no font has the characters " + characters + " " + consequence +
                    "; install fonts-noto-cjk or another font that has them");
}

}  // namespace

std::int64_t creation_time() {
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"))
    if (const std::optional<std::int64_t> seconds = to_integer(epoch); seconds && *seconds >= 0) return *seconds;
  return std::time(nullptr);
}

Result<InstructionsFile> instructions_file(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
                                           InstructionsFileOptions options) {
  const bool is_pdf = options.format == ExportFormat::InstructionsPdf;
  DISMANTLE_EXPECT(is_pdf || options.format == ExportFormat::InstructionsHtml);
  WorkInstructionsOptions& content = options.content;
  if (content.title_block.date.empty()) content.title_block.date = date_text(options.time);
  const FontCoverage fonts;
  content.missing_glyphs = {};
  if (is_pdf) content.missing_glyphs = [&fonts](const std::string& name) { return fonts.missing(name); };
  const Result<WorkInstructions> made = work_instructions(assembly, pairs, timeline, content);
  if (!made) return made.error();
  if (!is_pdf) return InstructionsFile{instructions_page(*made, options.paper), {}};

  InstructionsFile file;
  note_missing(made->missing_glyphs, "of component names, whose item numbers are printed instead", file.notes);
  std::string cover = made->title;
  for (const auto& [heading, text] : title_block_entries(made->title_block)) cover += text;
  note_missing(fonts.missing(cover), "of the cover, in whose place a replacement character is printed", file.notes);
  Result<std::string> pdf = instructions_pdf(*made, {options.paper, options.time});
  if (!pdf) return pdf.error();
  file.bytes = std::move(*pdf);
  return file;
}

}  // namespace dismantle
