// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_file.h"

#include "tests/instructions/bolted_lid.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

InstructionsFile written(const Assembly& assembly, ExportFormat format, const PaperSize& paper,
                         const std::string& date) {
  InstructionsFileOptions options;
  options.format = format;
  options.paper = paper;
  options.time = 1'700'000'000;  // 14 or 15 November 2023, by the time zone
  options.content.title_block.date = date;
  options.content.picture_width = 64;
  options.content.picture_height = 48;
  Result<InstructionsFile> file = instructions_file(assembly, scenes::bolted_lid_pairs(),
                                                    scenes::timeline_of(assembly, scenes::bolted_lid_path()), options);
  EXPECT_TRUE(file.ok()) << file.error().message;
  return std::move(*file);
}

TEST(InstructionsFile, IsAPageOrAPdfOnThePaper) {
  const Assembly a = scenes::bolted_lid();
  const InstructionsFile page = written(a, ExportFormat::InstructionsHtml, kPaperLetter, "");
  EXPECT_NE(page.bytes.find("size: letter"), std::string::npos);
  EXPECT_TRUE(page.notes.empty());
  const InstructionsFile pdf = written(a, ExportFormat::InstructionsPdf, kPaperLetter, "");
  EXPECT_EQ(pdf.bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.bytes.find("612 792"), std::string::npos);
}

TEST(InstructionsFile, IsDatedByItsTimeUnlessADateIsGiven) {
  const Assembly a = scenes::bolted_lid();
  EXPECT_NE(written(a, ExportFormat::InstructionsHtml, kPaperA4, "").bytes.find("2023-11-1"), std::string::npos);
  const std::string dated = written(a, ExportFormat::InstructionsHtml, kPaperA4, "1 May").bytes;
  EXPECT_NE(dated.find("1 May"), std::string::npos);
  EXPECT_EQ(dated.find("2023-11-1"), std::string::npos);
}

TEST(InstructionsFile, NotesTheCharactersThatNoFontHas) {
  Assembly a = scenes::bolted_lid();
  a.components[1].name = "lid \U000F1234";  // private use
  Path path = scenes::bolted_lid_path();
  path.components[1] = path.moves[2].components[0] = a.components[1].name;
  InstructionsFileOptions options;
  options.format = ExportFormat::InstructionsPdf;
  options.content.picture_width = 64;
  options.content.picture_height = 48;
  const Result<InstructionsFile> file =
      instructions_file(a, scenes::bolted_lid_pairs(), scenes::timeline_of(a, path), options);
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(file->notes.size(), 1u);
  EXPECT_NE(file->notes[0].find("\U000F1234"), std::string::npos) << file->notes[0];
}

}  // namespace
}  // namespace dismantle
