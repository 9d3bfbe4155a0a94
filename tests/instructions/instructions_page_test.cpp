// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_page.h"

#include "tests/instructions/bolted_lid.h"

#include <tinyxml2.h>

namespace dismantle {
namespace {

WorkInstructions of_lid() {
  const Assembly a = scenes::bolted_lid();
  WorkInstructionsOptions options;
  options.picture_width = 64;
  options.picture_height = 48;
  return *work_instructions(a, scenes::bolted_lid_pairs(), scenes::timeline_of(a, scenes::bolted_lid_path()), options);
}

TEST(InstructionsPage, IsWellFormedAndHasASectionAStep) {
  const std::string page = instructions_page(of_lid());
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(page.data(), page.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  std::size_t steps = 0;
  const auto* section = document.RootElement()->FirstChildElement("body")->FirstChildElement("section");
  for (; section != nullptr; section = section->NextSiblingElement("section"))
    if (section->Attribute("class", "step")) ++steps;
  EXPECT_EQ(steps, 2u);
}

TEST(InstructionsPage, LoadsNothingAndEscapesNames) {
  WorkInstructions instructions = of_lid();
  instructions.steps[0].title = "<script>alert(1)</script>\"onload='x' \xFF";
  const std::string page = instructions_page(instructions);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("http://www.w3.org/1999/xhtml"), page.find("http://")) << "only the name of the language";
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(page.data(), page.size()), tinyxml2::XML_SUCCESS);
}

TEST(InstructionsPage, IsTheSameForTheSameInput) {
  EXPECT_EQ(instructions_page(of_lid()), instructions_page(of_lid()));
}

}  // namespace
}  // namespace dismantle
