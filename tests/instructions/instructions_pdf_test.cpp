// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_pdf.h"

#include "tests/instructions/bolted_lid.h"

namespace dismantle {
namespace {

/// Steps of one grey picture each.
WorkInstructions grey_steps(std::size_t count) {
  const Image grey{40, 30, std::vector<Pixel>(40 * 30, Pixel{90, 90, 90})};
  WorkInstructions made;
  made.title = "Disassembly of \u9f7f\u8f6e <&> \xff";
  made.cover = grey;
  made.parts = {{"bolt", count, {1, 2, 3}, {1}, {}}};
  for (std::size_t i = 0; i < count; ++i)
    made.steps.push_back({"Remove bolt", {{0, 1}}, {{InstructionNote::Kind::Warning, "Hold it."}}, grey, {}});
  return made;
}

std::size_t pages_of(const std::string& pdf) {
  const std::size_t at = pdf.find("/Count ");
  return at == std::string::npos ? 0 : std::stoul(pdf.substr(at + 7));
}

TEST(InstructionsPdf, HasACoverAndThenThreeShortStepsAPage) {
  const Result<std::string> one = instructions_pdf(grey_steps(1)), seven = instructions_pdf(grey_steps(7));
  ASSERT_TRUE(one.ok() && seven.ok());
  EXPECT_EQ(one->substr(0, 5), "%PDF-");
  EXPECT_EQ(pages_of(*one), 2u);
  EXPECT_EQ(pages_of(*seven), 4u);
  EXPECT_EQ(pages_of(*instructions_pdf(grey_steps(6))), 3u) << "no remainder has a page to itself";
}

TEST(InstructionsPdf, BreaksLongPartsListsOverPages) {
  WorkInstructions instructions = grey_steps(1);
  instructions.parts.resize(120, instructions.parts[0]);
  const Result<std::string> pdf = instructions_pdf(instructions);
  ASSERT_TRUE(pdf.ok());
  EXPECT_GE(pages_of(*pdf), 4u);
}

TEST(InstructionsPdf, StatesItsPaperAuthorAndTime) {
  WorkInstructions instructions = grey_steps(1);
  instructions.title_block = {"4711", "B", "A. Smith", "2026-11-25"};
  const std::string a4 = *instructions_pdf(instructions, {kPaperA4, 1764072000});
  EXPECT_NE(a4.find("/MediaBox [ 0 0 595 842 ]"), std::string::npos);
  EXPECT_NE(a4.find("/Author (A. Smith)"), std::string::npos);
  EXPECT_NE(a4.find("20251125120000Z)"), std::string::npos) << a4.substr(a4.find("/CreationDate"), 50);
  EXPECT_NE(instructions_pdf(instructions, {kPaperLetter})->find("/MediaBox [ 0 0 612 792 ]"), std::string::npos);
}

TEST(InstructionsPdf, EmbedsItsFonts) {
  const std::string pdf = *instructions_pdf(grey_steps(1));
  const auto count = [&](const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = pdf.find(word); at != std::string::npos; at = pdf.find(word, at + 1)) ++found;
    return found;
  };
  EXPECT_GT(count("/FontDescriptor "), 0u);
  EXPECT_EQ(count("/Type /FontDescriptor"), count("/FontFile"));
}

TEST(InstructionsPdf, IsTheSameForTheSameInput) {
  EXPECT_EQ(*instructions_pdf(grey_steps(2)), *instructions_pdf(grey_steps(2)));
}

}  // namespace
}  // namespace dismantle
