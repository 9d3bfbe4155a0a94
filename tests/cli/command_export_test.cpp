// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/cli_fixture.h"
#include "tests/support/check_glb.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dismantle {
namespace {

using Json = nlohmann::json;

/// With the path of a block that moves by 7 mm and then up to the wall.
class CliExport : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ASSERT_EQ(run("move parts pull.motion.json -o pull.path.json --tolerance 0.01").exit_code, 0);
  }
  Outcome export_to(const std::string& arguments) const { return run("export parts pull.path.json -o " + arguments); }
};

TEST_F(CliExport, WritesAnAnimatedGlb) {
  const Outcome o = export_to("pull.glb --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(Json::parse(o.out)["moves"], 1);
  const CheckedGlb glb(read_all(in("pull.glb")));
  EXPECT_EQ(glb.faults(), std::vector<std::string>{});
  ASSERT_EQ(glb.json()["animations"].size(), 4u);
  const auto [times, places] = glb.keys(glb.json()["animations"][0], glb.node_of("block"), "translation");
  ASSERT_GE(times.size(), 3u);
  EXPECT_EQ(times[1], 0.1f);
  EXPECT_EQ(places[3], 0.007f);
}

TEST_F(CliExport, AssemblesIfReversed) {
  ASSERT_EQ(export_to("back.glb --reverse").exit_code, 0);
  const CheckedGlb glb(read_all(in("back.glb")));
  EXPECT_EQ(glb.faults(), std::vector<std::string>{});
  EXPECT_EQ(glb.json()["animations"][0]["name"], "all, reversed");
  EXPECT_GT(glb.json()["nodes"][glb.node_of("block")]["translation"][0], 0.0104) << "it begins disassembled";
}

TEST_F(CliExport, WritesASelfContainedPage) {
  ASSERT_EQ(export_to("pull.html").exit_code, 0);
  const std::string page = read_all(in("pull.html"));
  EXPECT_EQ(page.find("<!DOCTYPE html>"), 0u);
  EXPECT_NE(page.find("id=\"offline-model\""), std::string::npos);
  EXPECT_GT(page.size(), 400'000u) << "it does not contain the viewer";
  EXPECT_EQ(page.find("<link rel=\"stylesheet\""), std::string::npos);
  EXPECT_EQ(page.find("<script type=\"module\" src"), std::string::npos);
}

TEST_F(CliExport, TakesPicturesOfTheAssemblyAndOfAStep) {
  const std::string png("\x89PNG\r\n\x1a\n");
  ASSERT_EQ(run("export parts -o parts.png --size 160x120").exit_code, 0);
  ASSERT_EQ(export_to("step.png --size 160x120 --step 1 --view front").exit_code, 0);
  EXPECT_EQ(read_all(in("parts.png")).substr(0, 8), png);
  EXPECT_EQ(read_all(in("step.png")).substr(0, 8), png);
  expect_error("export parts pull.path.json -o step.png --step 2", 2, "there is no step 2 (the path has 1)");
  expect_error("export parts -o step.png --step 1", 2, "--step does not apply here");
  expect_error("export parts -o parts.png --size 0x7", 2, "is not a picture size");
}

TEST_F(CliExport, WritesTheVolumeThatAMoveSweeps) {
  const Outcome o = export_to("swept.stl --within 1 --json");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["within_mm"], 1);
  EXPECT_EQ(read_all(in("swept.stl")).size(), 84 + 50 * report["triangles"].get<std::size_t>());
  const Outcome read = run("info swept.stl --json");
  EXPECT_EQ(Json::parse(read.out)["assembly"]["triangles"], report["triangles"]);

  EXPECT_NE(export_to("swept.stl --step 1").out.find("outside the exact swept volume"), std::string::npos);
  expect_error("export parts pull.path.json -o swept.stl --step 2", 2, "there is no step 2 (the path has 1)");
  expect_error("export parts pull.path.json -o swept.stl --within 1e-6", 2, "too fine");
  expect_error("export parts pull.path.json -o pull.csv --within 1", 2, "--within does not apply");
  expect_error("export parts -o swept.stl", 2, "there is no path to export");
}

TEST_F(CliExport, WritesATableOfTheMoves) {
  ASSERT_EQ(export_to("pull.csv").exit_code, 0);
  const std::string csv = read_all(in("pull.csv"));
  EXPECT_EQ(csv.find("move,label,components,start_s,end_s,"), 0u);
  EXPECT_NE(csv.find("\r\n1,move block,block,0,0.2,"), std::string::npos) << csv;
}

TEST_F(CliExport, MeasuresTheClearanceOnRequest) {
  ASSERT_EQ(export_to("pull.csv --clearance").exit_code, 0);
  const std::string csv = read_all(in("pull.csv"));
  EXPECT_NE(csv.find(",0.2,wall\r\n"), std::string::npos) << csv;
}

TEST_F(CliExport, WritesTheBillOfMaterials) {
  ASSERT_EQ(run("export parts -o parts-bom.csv").exit_code, 0);
  EXPECT_NE(read_all(in("parts-bom.csv")).find("\r\n1,block,1,,,,10,10,10,1000,600,12,"), std::string::npos);
  ASSERT_EQ(run("export parts -o bom.json").exit_code, 0);
  EXPECT_EQ(Json::parse(read_all(in("bom.json")))["items"].size(), 2u);
}

TEST_F(CliExport, WritesAPathThatReadsBackAndPassesTheAudit) {
  ASSERT_EQ(export_to("same.path.json").exit_code, 0);
  EXPECT_EQ(Json::parse(read_all(in("same.path.json"))), Json::parse(read_all(in("pull.path.json"))));
  ASSERT_EQ(export_to("back.path.json --reverse").exit_code, 0);
  const Json back = Json::parse(read_all(in("back.path.json")));
  ASSERT_EQ(back["moves"].size(), 2u);
  EXPECT_EQ(back["moves"][1]["frames"].back()["position"], Json::array({0.0, 0.0, 0.0}));
  EXPECT_EQ(run("audit parts back.path.json").exit_code, 0);
}

TEST_F(CliExport, FindsTheAssemblyBesideAPathGivenAlone) {
  const Outcome o = run("export pull.path.json -o alone.glb");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(read_all(in("alone.glb")).substr(0, 4), "glTF");
  fs::rename(in("parts"), in("elsewhere"));
  expect_error("export pull.path.json -o alone.glb", 3, "is not in its folder");
}

TEST_F(CliExport, WritesWorkInstructions) {
  ASSERT_EQ(export_to("pull.pdf").exit_code, 0);
  EXPECT_EQ(read_all(in("pull.pdf")).substr(0, 5), "%PDF-");
  ASSERT_EQ(export_to("pull-instructions.html --reverse").exit_code, 0);
  const std::string page = read_all(in("pull-instructions.html"));
  const std::string folder = fs::path(in("parts")).parent_path().filename().string();
  EXPECT_NE(page.find("<h1>Assembly of " + folder + "</h1>"), std::string::npos) << "the folder that the parts are in";
  ASSERT_EQ(export_to("pull-instructions.html --product vice").exit_code, 0);
  EXPECT_NE(read_all(in("pull-instructions.html")).find("<h1>Disassembly of vice</h1>"), std::string::npos);
  expect_error("export parts pull.path.json -o pull.glb --product vice", 2, "--product does not apply");
  EXPECT_NE(page.find("id=\"step-1\""), std::string::npos);
  expect_error("export parts -o parts.pdf", 2, "there is no path to export");
}

TEST_F(CliExport, WritesPdfInstructionsWithPaperTitleBlockAndTime) {
  setenv("SOURCE_DATE_EPOCH", "1764072000", 1);
  const Outcome letter = export_to("vice.pdf --paper letter --revision B --author Smith --document-number 4711");
  const std::string once = read_all(in("vice.pdf"));
  ASSERT_EQ(export_to("vice.pdf --paper letter --revision B --author Smith --document-number 4711").exit_code, 0);
  ASSERT_EQ(export_to("vice-instructions.html --revision B --paper letter").exit_code, 0);
  unsetenv("SOURCE_DATE_EPOCH");
  ASSERT_EQ(letter.exit_code, 0) << letter.err;
  EXPECT_EQ(letter.err, "");
  EXPECT_NE(once.find("/MediaBox [ 0 0 612 792 ]"), std::string::npos);
  EXPECT_NE(once.find("20251125120000Z)"), std::string::npos);
  EXPECT_EQ(read_all(in("vice.pdf")), once);
  const std::string page = read_all(in("vice-instructions.html"));
  EXPECT_NE(page.find("<th>Date</th><td>2025-11-25</td>"), std::string::npos);
  EXPECT_NE(page.find("<th>Revision</th><td>B</td>"), std::string::npos);
  EXPECT_NE(page.find("size: letter"), std::string::npos);
  expect_error("export parts pull.path.json -o x.glb --author Smith", 2, "--author does not apply");
  expect_error("export parts pull.path.json -o x.pdf --paper a5", 2, "'a5' is not one of a4 or letter");
}

TEST_F(CliExport, NumbersPartsWhoseNamesNoFontHas) {
  fs::rename(in("parts/wall.obj"), in("parts/wall\U0010FFFD.obj"));
  const Outcome o = run("export parts pull.path.json -o pull.pdf --product \U0010FFFC");
  ASSERT_EQ(o.exit_code, 0) << o.err;
  EXPECT_NE(o.err.find("\U0010FFFD of component names, whose item numbers are printed"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("\U0010FFFC of the cover"), std::string::npos) << o.err;
}

TEST_F(CliExport, TakesTheFormatByNameIfTheFileHasNoExtension) {
  ASSERT_EQ(export_to("/dev/stdout --format bom-json").exit_code, 0);
  expect_error("export parts pull.path.json -o pull.xyz", 2, "instructions.html, .html, .pdf");
}

TEST_F(CliExport, RefusesInvalidArguments) {
  expect_error("export parts -o moves.csv", 2, "there is no path to export");
  expect_error("export parts -o parts.path.json", 2, "there is no path to export");
  expect_error("export parts -o bom.csv --reverse", 2, "--reverse has nothing to reverse");
  expect_error("export parts pull.path.json -o pull.glb --clearance", 2, "--clearance does not apply");
  EXPECT_FALSE(fs::exists(in("moves.csv")));
}

TEST_F(CliExport, RefusesAPathOfAnotherAssembly) {
  fs::rename(in("parts/block.obj"), in("parts/brick.obj"));
  expect_error("export parts pull.path.json -o pull.glb", 3, "the path cannot be played");
  EXPECT_FALSE(fs::exists(in("pull.glb")));
}

TEST_F(CliExport, LeavesTheOldFileIfItFails) {
  write("pull.glb", "what was there");
  write("broken.path.json", "{");
  expect_error("export parts broken.path.json -o pull.glb", 3, "broken.path.json");
  EXPECT_EQ(read_all(in("pull.glb")), "what was there");
  expect_error("export parts pull.path.json -o nowhere/pull.glb", 4, "nowhere");
}

}  // namespace
}  // namespace dismantle
