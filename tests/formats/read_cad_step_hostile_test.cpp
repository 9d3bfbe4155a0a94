// SPDX-License-Identifier: Apache-2.0
// Files that are broken, truncated or malicious: one Error each, and the process survives.
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <random>

namespace dismantle {
namespace {

std::string small_step(const ScratchFolder& folder) {
  CadWriter writer;
  const TDF_Label top = writer.assembly("top");
  const TDF_Label pin = writer.part("pin", BRepPrimAPI_MakeCylinder(2.0, 9.0).Shape());
  writer.instance(top, pin, translation(1, 2, 3));
  writer.instance(top, pin, translation(9, 2, 3));
  EXPECT_TRUE(writer.write(folder / "small.step"));
  return bytes_of(folder / "small.step");
}

/// The Error that reading the bytes gives; empty if they can be read.
std::string error_of(const ScratchFolder& folder, std::string_view bytes) {
  const Result<Assembly> a = load_assembly(folder.put("hostile.step", bytes), {});
  return a ? "" : a.error().message;
}

std::string step_of(std::string_view data) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" +
         std::string(data) + "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST(ReadStepHostile, ReportsFilesThatAreNotStep) {
  const ScratchFolder folder;
  EXPECT_NE(error_of(folder, "").find("it is empty"), std::string::npos);
  EXPECT_NE(error_of(folder, "solid cube\nendsolid\n").find("does not begin with ISO-10303-21"), std::string::npos);
  EXPECT_NE(error_of(folder, std::string("\x1f\x8b\x08", 3) + "xyz").find("gzip"), std::string::npos);
  EXPECT_NE(error_of(folder, "PK\x03\x04 and so on").find("zip"), std::string::npos);
  EXPECT_NE(load_assembly(folder / "missing.step", {}).error().message.find("no such file"), std::string::npos);
}

TEST(ReadStepHostile, ReportsTruncatedFiles) {
  const ScratchFolder folder;
  const std::string whole = small_step(folder);
  for (const double part : {0.1, 0.5, 0.9, 0.99})
    EXPECT_NE(error_of(folder, whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))))
                  .find("ends too early"),
              std::string::npos);
}

TEST(ReadStepHostile, RefusesFramesAroundNothingOrNonsense) {
  const ScratchFolder folder;
  EXPECT_NE(error_of(folder, step_of("")), "");
  EXPECT_NE(error_of(folder, step_of("#1=;;;((((\n")), "");
  EXPECT_NE(error_of(folder, step_of("#1=CARTESIAN_POINT('',(1.,2.,3.));\n")), "");
  EXPECT_NE(error_of(folder, step_of("#99999999999999999999=PRODUCT('','','',(#99999999999999999998));\n")), "");
  EXPECT_NE(error_of(folder, step_of("#1=PRODUCT('a','b','',(#1));\n#2=PRODUCT_DEFINITION('','',#2,#2);\n")), "");
  std::mt19937 random(11);
  std::string noise(20000, ' ');
  for (char& c : noise) c = static_cast<char>(random());
  EXPECT_NE(error_of(folder, step_of(noise)), "");
  EXPECT_NE(error_of(folder, step_of("#1=DIRECTION('',(" + std::string(200000, '(') + "));\n")), "");
}

/// A transformation operator with a parameter missing: OpenCASCADE 7.6.3 follows a null pointer.
TEST(ReadStepHostile, SurvivesACrashOfTheCadKernel) {
  const ScratchFolder folder;
  CadWriter writer;
  writer.part("pin", BRepPrimAPI_MakeCylinder(2.0, 9.0).Shape());
  ASSERT_TRUE(writer.write(folder / "pin.step"));
  std::string text = bytes_of(folder / "pin.step");
  const std::size_t shape = text.find("SHAPE_DEFINITION_REPRESENTATION(#4,#10)");
  ASSERT_NE(shape, std::string::npos);
  text.replace(shape, 39, "SHAPE_DEFINITION_REPRESENTATION(#4,#9001)");
  text.replace(text.rfind("ENDSEC;"), 7,
               "#9001=SHAPE_REPRESENTATION('',(#11,#9002),#9009);\n#9002=MAPPED_ITEM('',#9003,#9004);\n"
               "#9003=REPRESENTATION_MAP(#11,#10);\n#9005=DIRECTION('',(1.,0.,0.));\n"
               "#9006=CARTESIAN_POINT('',(5.,0.,0.));\n"
               "#9004=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',#9005,#9005,#9006,2.,$);\nENDSEC;");
  const std::string error = error_of(folder, text);
  EXPECT_NE(error.find("the CAD kernel crashed on it"), std::string::npos) << error;
}

TEST(ReadStepHostile, RefusesATreeThatExplodes) {
  const ScratchFolder folder;
  CadWriter writer;
  TDF_Label level = writer.part("pin", BRepPrimAPI_MakeCylinder(2.0, 9.0).Shape());
  for (int i = 0; i < 13; ++i) {  // 8192 pins
    const TDF_Label above = writer.assembly(("level " + std::to_string(i)).c_str());
    writer.instance(above, level, gp_Trsf());
    writer.instance(above, level, translation(1 << i, 0, 0));
    level = above;
  }
  ASSERT_TRUE(writer.write(folder / "explodes.step"));
  ImportOptions options;
  options.limits.components = 1000;
  const Result<Assembly> a = load_assembly(folder / "explodes.step", options);
  ASSERT_FALSE(a.ok());
  EXPECT_NE(a.error().message.find("more than 1000 components"), std::string::npos) << a.error().message;
}

TEST(ReadStepHostile, ReadsOrRefusesFilesWithChangedBytesAndLines) {
  const ScratchFolder folder;
  const std::string whole = small_step(folder);
  const unsigned seed = 2024;
  std::mt19937 random(seed);
  const std::string alphabet = "0123456789#(),.'$*-E;";
  const std::size_t body = whole.find("DATA;");
  int read = 0;
  for (int round = 0; round < 40; ++round) {
    std::string changed = whole;
    for (int k = 0; k < 1 + round % 6; ++k)
      changed[body + random() % (whole.size() - body - 40)] = alphabet[random() % alphabet.size()];
    const Result<Assembly> a = load_assembly(folder.put("changed.step", changed), {});
    EXPECT_TRUE(a.ok() || !a.error().message.empty());
    read += a.ok() ? 1 : 0;
  }
  std::printf("seed %u: %d of 40 changed files could still be read\n", seed, read);
}

}  // namespace
}  // namespace dismantle
