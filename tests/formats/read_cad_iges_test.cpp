// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/formats/same_assembly.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopExp_Explorer.hxx>
#include <cmath>

namespace dismantle {
namespace {

using IgesSolids = CadWriter::IgesSolids;
const double kPi = std::acos(-1.0);

TopoDS_Shape bored_block() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(20.0, 20.0, 10.0).Shape(),
                         BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(10, 10, -1), gp_Dir(0, 0, 1)), 5, 20).Shape());
}

/// A bored block, a pin in it, and two balls.
void fill(CadWriter& writer) {
  const TDF_Label top = writer.assembly("top");
  const TDF_Label block = writer.part("block", bored_block());
  const TDF_Label pin = writer.part("pin", BRepPrimAPI_MakeCylinder(5.0, 30.0).Shape());
  const TDF_Label ball = writer.part("ball", BRepPrimAPI_MakeSphere(3.0).Shape());
  writer.instance(top, block, gp_Trsf());
  writer.instance(top, pin, translation(10, 10, 0), "a pin");
  writer.instance(top, ball, translation(50, 0, 0));
  writer.instance(top, ball, translation(0, 50, 0) * rotation_about_z(kPi / 2));
  writer.color(pin, 1, 0, 0);
}

class IgesOfKind : public ::testing::TestWithParam<IgesSolids> {};

TEST_P(IgesOfKind, GivesTheComponentsOfTheStepFile) {
  const ScratchFolder folder;
  CadWriter writer;
  fill(writer);
  ASSERT_TRUE(writer.write(folder / "a.step"));
  ASSERT_TRUE(writer.write_iges(folder / "a.igs", GetParam()));
  const Result<Assembly> step = load_assembly(folder / "a.step", {}), iges = load_assembly(folder / "a.igs", {});
  ASSERT_TRUE(step.ok() && iges.ok()) << (iges ? "" : iges.error().message);
  expect_same_components(*step, *iges, 1e-3, 0.01);
  for (const Component& c : iges->components) EXPECT_TRUE(c.faults.bounds_solid()) << c.name;
  EXPECT_EQ(iges->source_units, "mm");
}

TEST_P(IgesOfKind, ConvertsUnits) {
  const ScratchFolder folder;
  for (const auto& [written, name] : {std::pair("INCH", "in"), {"M", "m"}}) {
    CadWriter writer;
    writer.part("block", bored_block());
    ASSERT_TRUE(writer.write_iges(folder / "unit.iges", GetParam(), written));
    const Result<Assembly> a = load_assembly(folder / "unit.iges", {});
    ASSERT_TRUE(a.ok()) << a.error().message;
    EXPECT_EQ(a->source_units, name);
    ASSERT_EQ(a->components.size(), 1u);
    EXPECT_NEAR(signed_volume(*a->components[0].mesh), 20 * 20 * 10 - kPi * 25 * 10, 5);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, IgesOfKind, ::testing::Values(IgesSolids::TrimmedSurfaces, IgesSolids::Brep),
                         [](const auto& kind) { return kind.param == IgesSolids::Brep ? "Brep" : "TrimmedSurfaces"; });

TEST(ReadCadIges, KeepsNamesAndColours) {
  const ScratchFolder folder;
  CadWriter writer;
  writer.part("block", bored_block());
  const TDF_Label pin = writer.part("pin", BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(50, 0, 0), gp_Dir(0, 0, 1)), 5, 30));
  writer.color(pin, 1, 0, 0);
  ASSERT_TRUE(writer.write_iges(folder / "a.igs", IgesSolids::TrimmedSurfaces));
  const Result<Assembly> a = load_assembly(folder / "a.igs", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_TRUE(a->find("block") && a->find("pin"));
  EXPECT_NEAR((*a)[*a->find("pin")].color.r, 1, 0.01);
  EXPECT_NEAR((*a)[*a->find("pin")].color.g, 0, 0.01);
}

TEST(ReadCadIges, KeepsSheetsOpen) {
  const ScratchFolder folder;
  CadWriter writer;
  TopExp_Explorer face(bored_block(), TopAbs_FACE);
  writer.part("sheet", face.Current());
  ASSERT_TRUE(writer.write_iges(folder / "sheet.igs", IgesSolids::TrimmedSurfaces));
  const Result<Assembly> a = load_assembly(folder / "sheet.igs", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 1u);
  EXPECT_GT(a->components[0].faults.open_edges, 0u);
}

TEST(ReadCadIges, SaysWhatIsWrongWithAFile) {
  const ScratchFolder folder;
  CadWriter writer;
  fill(writer);
  ASSERT_TRUE(writer.write_iges(folder / "a.igs", IgesSolids::Brep));
  const std::string whole = bytes_of(folder / "a.igs");
  const auto error_of = [&](std::string_view bytes) {
    const Result<Assembly> a = load_assembly(folder.put("b.igs", bytes), {});
    return a ? std::string() : a.error().message;
  };
  EXPECT_NE(error_of(whole.substr(0, whole.size() / 2)).find("ends too early"), std::string::npos);
  EXPECT_NE(error_of("solid cube\nendsolid\n").find("start section"), std::string::npos);
  EXPECT_NE(error_of(std::string(72, ' ') + "C0000001\n").find("compressed form"), std::string::npos);
  const std::string nothing = std::string(72, ' ') + "S0000001\n" + std::string(72, ' ') + "T0000001\n";
  EXPECT_NE(error_of(nothing), "");
}

}  // namespace
}  // namespace dismantle
