// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/exported_file.h"

#include "dismantle/documents/path_file.h"
#include "tests/export/export_scene.h"
#include "tests/support/check_glb.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

std::string made(ExportFormat format, PathDirection direction = PathDirection::Forward) {
  ExportOptions options;
  options.direction = direction;
  const Result<std::string> file = exported_file(format, scenes::knob_on_block(), scenes::knob_path(), options);
  EXPECT_TRUE(file.ok());
  return file.ok() ? *file : std::string();
}

TEST(ExportedFile, HasTheFormatRequested) {
  EXPECT_EQ(CheckedGlb(made(ExportFormat::Glb)).json()["animations"].size(), 8u);
  EXPECT_EQ(made(ExportFormat::Html).find("<!DOCTYPE html>"), 0u);
  EXPECT_EQ(made(ExportFormat::Moves).find("move,label,"), 0u);
  EXPECT_EQ(made(ExportFormat::BillCsv).find("item,name,"), 0u);
  EXPECT_EQ(nlohmann::json::parse(made(ExportFormat::BillJson))["format"], "dismantle-bill");
  EXPECT_EQ(*parse_path(made(ExportFormat::Path), "a.path.json"), scenes::knob_path());
}

TEST(ExportedFile, BeginsDisassembledIfReversed) {
  const CheckedGlb glb(made(ExportFormat::Glb, PathDirection::Reversed));
  EXPECT_NEAR(glb.json()["nodes"][glb.node_of("block")]["translation"][1].get<double>(), 0.06, 1e-9);
  EXPECT_EQ(parse_path(made(ExportFormat::Path, PathDirection::Reversed), "a.path.json")->moves.size(), 6u);
}

TEST(ExportedFile, IsNotMadeOfAPathThatDoesNotFit) {
  Path path = scenes::knob_path();
  path.moves[0].components = {"lid"};
  const Result<std::string> file = exported_file(ExportFormat::Glb, scenes::knob_on_block(), path);
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().kind, ErrorKind::Unreadable);
}

}  // namespace
}  // namespace dismantle
