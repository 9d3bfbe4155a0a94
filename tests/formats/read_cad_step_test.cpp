// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/read_cad.h"
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <cmath>
#include <map>

namespace dismantle {
namespace {

const double kPi = std::acos(-1.0);

TopoDS_Shape block() {
  return BRepPrimAPI_MakeBox(10.0, 20.0, 30.0).Shape();
}

TopoDS_Shape compound_of(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

/// The name and those of its parents, from the leaf up.
std::string tree_path(const Assembly& a, std::uint32_t node) {
  std::string path = a.tree[node].name;
  while (a.tree[node].parent != node) path += " < " + a.tree[node = a.tree[node].parent].name;
  return path;
}

void expect_color(const Color& color, double r, double g, double b) {
  EXPECT_NEAR(color.r, r, 1e-3);
  EXPECT_NEAR(color.g, g, 1e-3);
  EXPECT_NEAR(color.b, b, 1e-3);
}

void expect_box(const Aabb& box, Vec3 lower, Vec3 upper, double tolerance = 1e-9) {
  EXPECT_LT(max_abs(box.lower - lower), tolerance);
  EXPECT_LT(max_abs(box.upper - upper), tolerance);
}

// top -+- pair (at x = 100) -+- block (at 0)
//      |                     +- block (a quarter turn about z, at y = 50)
//      +- pair (at x = 200) ... the same
//      +- ball
class NestedStep : public ::testing::Test {
 protected:
  void SetUp() override {
    CadWriter writer;
    const TDF_Label block_label = writer.part("block", block());
    const TDF_Label ball = writer.part("ball", BRepPrimAPI_MakeSphere(5.0).Shape());
    const TDF_Label pair = writer.assembly("pair");
    writer.instance(pair, block_label, gp_Trsf(), "left");
    const TDF_Label right =
        writer.instance(pair, block_label, translation(0, 50, 0) * rotation_about_z(kPi / 2), "right");
    const TDF_Label top = writer.assembly("top");
    writer.instance(top, pair, translation(100, 0, 0), "first");
    writer.instance(top, pair, translation(200, 0, 0), "second");
    writer.instance(top, ball, translation(0, 0, 77), "the ball");
    writer.color(block_label, 0.2, 0.4, 0.6);
    writer.color(right, 1, 0, 0);
    file_ = folder_ / "nested.step";
    ASSERT_TRUE(writer.write(file_));
  }
  ScratchFolder folder_;
  std::filesystem::path file_;
};

TEST_F(NestedStep, MakesAComponentOfEachOccurrenceOfASolid) {
  const Result<Assembly> a = load_assembly(file_, {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->source_file, "nested.step");
  EXPECT_EQ(a->source_sha256.size(), 64u);
  EXPECT_EQ(a->source_units, "mm");
  ASSERT_EQ(a->components.size(), 5u);
  const char* names[] = {"block", "block#2", "block#3", "block#4", "ball"};
  const char* paths[] = {"block < pair < top", "block < pair < top", "block < pair < top", "block < pair < top",
                         "ball < top"};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(a->components[i].name, names[i]);
    EXPECT_EQ(tree_path(*a, a->components[i].tree_node), paths[i]);
    EXPECT_TRUE(a->components[i].faults.closed());
  }
  EXPECT_NE(a->components[0].tree_node, a->components[1].tree_node);
}

TEST_F(NestedStep, PlacesInstancesAndSharesTheirMesh) {
  const Result<Assembly> a = load_assembly(file_, {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  for (int i = 1; i < 4; ++i) EXPECT_EQ(a->components[0].mesh, a->components[static_cast<std::size_t>(i)].mesh);
  EXPECT_EQ(a->components[0].mesh->faces.size(), 12u);
  EXPECT_EQ(a->components[0].mesh->vertices.size(), 8u);
  expect_box(assembled_bounds(a->components[0]), {100, 0, 0}, {110, 20, 30});
  expect_box(assembled_bounds(a->components[1]), {80, 50, 0}, {100, 60, 30});
  expect_box(assembled_bounds(a->components[2]), {200, 0, 0}, {210, 20, 30});
  expect_box(assembled_bounds(a->components[3]), {180, 50, 0}, {200, 60, 30});
  for (const Component& c : a->components) EXPECT_GT(signed_volume(assembled_mesh(c)), 0);
}

TEST_F(NestedStep, TakesColoursFromTheInstanceThenTheProduct) {
  const Result<Assembly> a = load_assembly(file_, {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  expect_color(a->components[0].color, 0.2, 0.4, 0.6);
  expect_color(a->components[1].color, 1, 0, 0);
  EXPECT_EQ(a->components[4].color, Color{});
}

TEST_F(NestedStep, RefusesMoreComponentsOrTrianglesThanTheLimit) {
  ImportOptions options;
  options.limits.components = 4;
  EXPECT_NE(load_assembly(file_, options).error().message.find("more than 4 components"), std::string::npos);
  options.limits.components = 5;
  options.limits.triangles = 40;
  EXPECT_NE(load_assembly(file_, options).error().message.find("more than 40 triangles"), std::string::npos);
}

TEST_F(NestedStep, ReportsProgressAndCanBeCancelled) {
  ImportOptions options;
  int calls = 0;
  options.progress = [&](std::string_view, double) { return ++calls < 1; };
  const Result<Assembly> a = load_assembly(file_, options);
  EXPECT_EQ(calls, 1);
  ASSERT_FALSE(a.ok());
  EXPECT_EQ(a.error().kind, ErrorKind::Failed);
  EXPECT_EQ(a.error().message, "cancelled");
}

TEST_F(NestedStep, ReadsTheSameBytesEveryTime) {
  const Result<Assembly> a = load_assembly(file_, {}), b = load_assembly(file_, {});
  ASSERT_TRUE(a.ok() && b.ok());
  for (std::size_t i = 0; i < a->components.size(); ++i) EXPECT_EQ(*a->components[i].mesh, *b->components[i].mesh);
}

/// The files of a folder, each with its number on the disk, which changes when it is written anew.
std::map<std::filesystem::path, std::uint64_t> files_in(const std::filesystem::path& folder) {
  std::map<std::filesystem::path, std::uint64_t> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    struct stat status {};
    EXPECT_EQ(::stat(entry.path().c_str(), &status), 0);
    files[entry.path()] = status.st_ino;
  }
  return files;
}

TEST_F(NestedStep, IsTheSameOutOfTheCache) {
  ImportOptions options;
  options.cache_folder = folder_ / "cache";
  const Result<Assembly> fresh = load_assembly(file_, options);
  ASSERT_TRUE(fresh.ok());
  const auto first = files_in(options.cache_folder);
  EXPECT_EQ(first.size(), 1u);
  const Result<Assembly> kept = load_assembly(file_, options);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(files_in(options.cache_folder), first);
  EXPECT_EQ(kept->source_sha256, fresh->source_sha256);
  EXPECT_EQ(kept->source_file, "nested.step");
  ASSERT_EQ(kept->components.size(), fresh->components.size());
  for (std::size_t i = 0; i < fresh->components.size(); ++i) {
    EXPECT_EQ(kept->components[i].name, fresh->components[i].name);
    EXPECT_EQ(*kept->components[i].mesh, *fresh->components[i].mesh);
    EXPECT_EQ(kept->components[i].assembly_from_mesh, fresh->components[i].assembly_from_mesh);
  }

  options.deflection = 0.5;  // other triangles
  EXPECT_TRUE(load_assembly(file_, options).ok());
  EXPECT_EQ(files_in(options.cache_folder).size(), 2u);
  options.units = "cm";
  EXPECT_TRUE(load_assembly(file_, options).ok());
  const auto three = files_in(options.cache_folder);
  EXPECT_EQ(three.size(), 3u);
  for (const auto& [file, number] : three) std::filesystem::resize_file(file, 1000);
  EXPECT_TRUE(load_assembly(file_, options).ok());
  const auto after = files_in(options.cache_folder);
  EXPECT_EQ(after.size(), 3u);
  EXPECT_NE(after, three);
}

TEST(ReadStep, LeavesOutNoConicalFace) {
  // The chamfer of a hole, on which OpenCASCADE 7.6 gives up at some deflections.
  for (const double deflection : {0.002, 0.005, 0.0078, 0.01, 0.03}) {
    ImportOptions options;
    options.deflection = deflection;
    const Result<Assembly> a =
        load_assembly(std::filesystem::path(DISMANTLE_SOURCE_DIR) / "tests/formats/chamfer.step", options);
    ASSERT_TRUE(a.ok()) << a.error().message;
    ASSERT_EQ(a->components.size(), 1u);
    double area = 0;
    const TriangleMesh& mesh = *a->components[0].mesh;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) area += length(normal_unscaled(mesh.triangle(f))) / 2;
    const double slant = 0.5 * std::sqrt(2.0);
    EXPECT_NEAR(area, kPi * (1.5 + 2) * slant, 0.05) << "deflection " << deflection;
  }
}

TEST(ReadStep, MakesAComponentOfEachSolidOfAProductAndOneOfItsLooseFaces) {
  const ScratchFolder folder;
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(50, 0, 0), 5.0).Shape();
  const TopoDS_Shape open = BRepPrimAPI_MakeBox(gp_Pnt(-30, 0, 0), 1.0, 1.0, 1.0).Shell();
  CadWriter writer;
  writer.part("mixed", compound_of({block(), ball, open}));
  ASSERT_TRUE(writer.write(folder / "mixed.stp"));
  const Result<Assembly> a = load_assembly(folder / "mixed.stp", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), 3u);
  EXPECT_EQ(a->components[0].name, "mixed");
  EXPECT_EQ(a->components[2].name, "mixed#3");
  EXPECT_EQ(tree_path(*a, a->components[1].tree_node), "mixed < mixed");
}

TEST(ReadStep, JoinsTheSolidsOfAProductWhereAsked) {
  CadWriter writer;
  const TopoDS_Shape there = BRepPrimAPI_MakeBox(gp_Pnt(50, 0, 0), 1.0, 1.0, 1.0).Shape();
  writer.part("two", compound_of({block(), there}));
  writer.part("one", block());
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "solids.step";
  ASSERT_TRUE(writer.write(file));
  ImportOptions options;
  EXPECT_EQ(load_assembly(file, options)->components.size(), 3u);
  options.solids = Solids::Join;
  const Result<Assembly> joined = load_assembly(file, options);
  ASSERT_EQ(joined->components.size(), 2u);
  EXPECT_EQ(joined->components[0].name, "two");
  EXPECT_EQ(joined->components[0].mesh->faces.size(), 24u);
  EXPECT_TRUE(joined->components[0].faults.closed());
  expect_box(assembled_bounds(joined->components[0]), {0, 0, 0}, {51, 20, 30});
}

TEST(ReadStep, TakesTheColourOfTheLargestArea) {
  const ScratchFolder folder;
  const TopoDS_Shape shape = block();
  CadWriter writer;
  const TDF_Label part = writer.part("painted", shape);
  TopExp_Explorer faces(shape, TopAbs_FACE);  // two of 600 mm^2, two of 300, two of 200
  writer.color(part, 0, 0, 1);
  writer.color(part, faces.Current(), 1, 0, 0);
  ASSERT_TRUE(writer.write(folder / "painted.step"));
  Result<Assembly> a = load_assembly(folder / "painted.step", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  expect_color(a->components[0].color, 0, 0, 1);  // 1600 mm^2 of 2200

  faces.Next();
  writer.color(part, faces.Current(), 1, 0, 0);
  ASSERT_TRUE(writer.write(folder / "painted.step"));
  a = load_assembly(folder / "painted.step", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  expect_color(a->components[0].color, 1, 0, 0);  // 1200 mm^2 of 2200
}

TEST(ReadStep, ConvertsUnitsAndLetsTheUserOverrideThem) {
  const ScratchFolder folder;
  for (const auto& [written, name] : {std::pair("MM", "mm"), {"INCH", "in"}, {"M", "m"}, {"CM", "cm"}}) {
    CadWriter writer;
    const TDF_Label top = writer.assembly("top");
    writer.instance(top, writer.part("block", block()), translation(254, 0, 0));
    ASSERT_TRUE(writer.write(folder / "unit.step", written));
    const Result<Assembly> a = load_assembly(folder / "unit.step", {});
    ASSERT_TRUE(a.ok()) << a.error().message;
    EXPECT_EQ(a->source_units, name);
    expect_box(assembled_bounds(*a), {254, 0, 0}, {264, 20, 30}, 1e-6);
  }
  ImportOptions options;
  options.units = "in";  // the file is in centimetres
  const Result<Assembly> a = load_assembly(folder / "unit.step", options);
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->source_units, "in");
  expect_box(assembled_bounds(*a), 2.54 * Vec3{254, 0, 0}, 2.54 * Vec3{264, 20, 30}, 1e-6);
  options.units = "furlong";
  EXPECT_EQ(load_assembly(folder / "unit.step", options).error().kind, ErrorKind::Usage);
}

TEST(ReadStep, MeshesCurvedFacesClosedAndWithinTheDeflection) {
  const ScratchFolder folder;
  const double radius = 20, height = 50;
  CadWriter writer;
  writer.part("all", compound_of({BRepPrimAPI_MakeCylinder(radius, height).Shape(),
                                  BRepPrimAPI_MakeSphere(gp_Pnt(100, 0, 0), 10.0).Shape(),
                                  BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(200, 0, 0), gp_Dir(0, 0, 1)), 10, 0, 30).Shape(),
                                  BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(300, 0, 0), gp_Dir(0, 1, 0)), 20, 5).Shape()}));
  ASSERT_TRUE(writer.write(folder / "curved.step"));
  std::size_t coarser = 0;
  for (const double deflection : {0.2, 0.01}) {
    ImportOptions options;
    options.deflection = deflection;
    const Result<Assembly> a = load_assembly(folder / "curved.step", options);
    ASSERT_TRUE(a.ok()) << a.error().message;
    EXPECT_EQ(a->deflection, deflection);
    ASSERT_EQ(a->components.size(), 4u);
    for (const Component& c : a->components) EXPECT_TRUE(c.faults.closed()) << c.name;
    for (const Component& c : a->components) EXPECT_FALSE(c.faults.inside_out) << c.name;

    double depth = 0;  // of edge midpoints below the cylinder's wall
    const TriangleMesh& m = *a->components[0].mesh;
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
      const Triangle t = m.triangle(f);
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = t[k], q = t[(k + 1) % 3], mid = 0.5 * (p + q);
        if (std::hypot(p.x, p.y) < radius - 1e-6 || std::hypot(q.x, q.y) < radius - 1e-6) continue;
        if (std::abs(normalized(normal_unscaled(t)).z) > 0.5) continue;  // a cap
        depth = std::max(depth, radius - std::hypot(mid.x, mid.y));
      }
    }
    EXPECT_GT(depth, 0);
    EXPECT_LE(depth, deflection);
    EXPECT_GT(triangle_count(*a), coarser);
    coarser = triangle_count(*a);
  }
}

TEST(ReadStep, UsesOneDocumentedDeflectionByDefault) {
  const ScratchFolder folder;
  CadWriter writer;
  writer.part("block", block());
  ASSERT_TRUE(writer.write(folder / "block.step"));
  const Result<Assembly> a = load_assembly(folder / "block.step", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_NEAR(a->deflection, kDefaultRelativeDeflection * std::sqrt(100 + 400 + 900), 1e-6);
}

TEST(ReadStep, RefinesByAngleWhatTheDeflectionLeavesCoarse) {
  const ScratchFolder folder;
  CadWriter writer;
  writer.part("pin", BRepPrimAPI_MakeCylinder(1.0, 5.0).Shape());
  ASSERT_TRUE(writer.write(folder / "pin.step"));
  ImportOptions options;
  options.deflection = 10;
  options.angular_deflection = 2 * kPi / 60;
  const Result<Assembly> a = load_assembly(folder / "pin.step", options);
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_GE(a->components[0].mesh->vertices.size(), 120u);  // 60 per rim
  options.angular_deflection = 0;
  EXPECT_GE(load_assembly(folder / "pin.step", options)->components[0].mesh->vertices.size(), 36u);
}

TEST(ReadStep, KeepsNamesOfOtherScripts) {
  const ScratchFolder folder;
  CadWriter writer;
  writer.part("Gehäuse 螺栓 'x'", block());
  ASSERT_TRUE(writer.write(folder / "names.step"));
  const Result<Assembly> a = load_assembly(folder / "names.step", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->components[0].name, "Gehäuse 螺栓 'x'");
}

}  // namespace
}  // namespace dismantle
