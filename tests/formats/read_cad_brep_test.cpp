// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/formats/same_assembly.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>

namespace dismantle {
namespace {

const double kPi = std::acos(-1.0);

TopoDS_Shape compound_of(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

Assembly read_shape(const ScratchFolder& folder, const TopoDS_Shape& shape, const ImportOptions& options = {}) {
  EXPECT_TRUE(BRepTools::Write(shape, (folder / "shape.brep").c_str()));
  Result<Assembly> a = load_assembly(folder / "shape.brep", options);
  EXPECT_TRUE(a.ok()) << a.error().message;
  return a ? std::move(*a) : Assembly();
}

TEST(ReadCadBrep, GivesTheComponentsOfTheStepFile) {
  const ScratchFolder folder;
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(4.0).Shape(), pin = BRepPrimAPI_MakeCylinder(2.0, 9.0).Shape();
  const gp_Trsf there = translation(30, 0, 0) * rotation_about_z(1);
  CadWriter writer;
  const TDF_Label top = writer.assembly("top"), ball_label = writer.part("ball", ball);
  writer.instance(top, ball_label, gp_Trsf());
  writer.instance(top, ball_label, translation(0, 20, 0));
  writer.instance(top, writer.part("pin", pin), there);
  ASSERT_TRUE(writer.write(folder / "a.step"));
  const Result<Assembly> step = load_assembly(folder / "a.step", {});
  ASSERT_TRUE(step.ok());

  const TopoDS_Shape shape =
      compound_of({ball, ball.Located(TopLoc_Location(translation(0, 20, 0))), pin.Located(TopLoc_Location(there))});
  const Assembly text = read_shape(folder, shape);
  expect_same_components(*step, text, 1e-6, 1e-6);
  EXPECT_EQ(text.components[0].name, "shape");
  EXPECT_EQ(text.components[0].mesh, text.components[1].mesh);

  ASSERT_TRUE(BinTools::Write(shape, (folder / "binary.brp").c_str()));
  const Result<Assembly> binary = load_assembly(folder / "binary.brp", {});
  ASSERT_TRUE(binary.ok()) << binary.error().message;
  expect_same_components(*step, *binary, 1e-6, 1e-6);
}

TEST(ReadCadBrep, MakesNodesOfNestedCompounds) {
  const ScratchFolder folder;
  const TopoDS_Shape pair = compound_of(
      {BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(), BRepPrimAPI_MakeBox(gp_Pnt(5, 0, 0), 1.0, 1.0, 1.0).Shape()});
  const Assembly a = read_shape(folder, compound_of({pair, pair.Located(TopLoc_Location(translation(0, 10, 0))),
                                                     BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 9), 1.0, 1.0, 1.0).Shape()}));
  ASSERT_EQ(a.components.size(), 5u);
  EXPECT_EQ(a.tree[a.components[0].tree_node].parent, a.tree[a.components[1].tree_node].parent);
  EXPECT_NE(a.tree[a.components[0].tree_node].parent, a.tree[a.components[2].tree_node].parent);
  EXPECT_EQ(a.components[0].mesh, a.components[2].mesh);
  EXPECT_NEAR(assembled_bounds(a.components[3]).lower.y, 10, 1e-9);
  ImportOptions join;
  join.solids = Solids::Join;
  EXPECT_EQ(read_shape(folder, compound_of({pair, pair}), join).components.size(), 2u);
}

TEST(ReadCadBrep, MakesComponentsOfShellsAndSheetsAndLeavesOutWires) {
  const ScratchFolder folder;
  const TopoDS_Shape shell = BRepPrimAPI_MakeBox(gp_Pnt(9, 0, 0), 1.0, 1.0, 1.0).Shell();
  TopExp_Explorer faces(BRepPrimAPI_MakeBox(gp_Pnt(20, 0, 0), 1.0, 1.0, 1.0).Shape(), TopAbs_FACE);
  const TopoDS_Shape edge = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(0, 0, 9)).Shape();
  const Assembly a =
      read_shape(folder, compound_of({BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape(), shell, faces.Current(), edge}));
  ASSERT_EQ(a.components.size(), 3u);
  EXPECT_TRUE(a.components[1].faults.bounds_solid());
  EXPECT_GT(a.components[2].faults.open_edges, 0u);
}

TEST(ReadCadBrep, ReportsShellsThatAreInsideOut) {
  const ScratchFolder folder;
  const Assembly a = read_shape(folder, BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shell().Reversed());
  ASSERT_EQ(a.components.size(), 1u);
  EXPECT_TRUE(a.components[0].faults.inside_out);
}

TEST(ReadCadBrep, TakesTheUnitFromTheUser) {
  const ScratchFolder folder;
  ImportOptions options;
  options.units = "m";
  const Assembly a = read_shape(folder, BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), options);
  EXPECT_NEAR(assembled_bounds(a).upper.z, 3000, 1e-6);
}

TEST(ReadCadBrep, SaysWhatIsWrongWithAFile) {
  const ScratchFolder folder;
  const auto error_of = [&](std::string_view bytes) {
    const Result<Assembly> a = load_assembly(folder.put("b.brep", bytes), {});
    return a ? std::string() : a.error().message;
  };
  ASSERT_TRUE(BRepTools::Write(BRepPrimAPI_MakeSphere(4.0).Shape(), (folder / "ball.brep").c_str()));
  const std::string whole = bytes_of(folder / "ball.brep");
  EXPECT_NE(error_of("solid cube\nendsolid\n").find("does not begin with CASCADE Topology"), std::string::npos);
  for (const double part : {0.1, 0.5, 0.9})
    EXPECT_NE(error_of(whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size())))), "");
  std::string huge = whole;
  huge.replace(huge.find("Surfaces 1"), 10, "Surfaces 2000000000");
  EXPECT_NE(error_of(huge), "");
  ASSERT_TRUE(BRepTools::Write(compound_of({}), (folder / "empty.brep").c_str()));
  EXPECT_NE(error_of(bytes_of(folder / "empty.brep")).find("no solid and no surface"), std::string::npos);
  ASSERT_TRUE(BRepTools::Write(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(0, 0, 9)).Shape(),
                               (folder / "edge.brep").c_str()));
  EXPECT_NE(error_of(bytes_of(folder / "edge.brep")).find("no solid and no surface"), std::string::npos);
}

TEST(ReadCadBrep, RefusesCompoundsThatExplode) {
  const ScratchFolder folder;
  TopoDS_Shape level = BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape();
  for (int i = 0; i < 40; ++i) level = compound_of({level, level.Located(TopLoc_Location(translation(2, 0, 0)))});
  ASSERT_TRUE(BRepTools::Write(level, (folder / "explodes.brep").c_str()));
  ImportOptions options;
  options.limits.components = 1000;
  const Result<Assembly> a = load_assembly(folder / "explodes.brep", options);
  ASSERT_FALSE(a.ok());
  EXPECT_NE(a.error().message.find("more than 1000 components"), std::string::npos) << a.error().message;
}

}  // namespace
}  // namespace dismantle
