// SPDX-License-Identifier: Apache-2.0
// VRML files that OpenCASCADE writes: the components of the STEP file of the same shapes.
#include "dismantle/formats/vrml/read_vrml.h"
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/formats/same_assembly.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <VrmlAPI_Writer.hxx>

namespace dismantle {
namespace {

TEST(ReadOpenCascadesVrml, GivesTheComponentsOfTheStepFile) {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(20.0, 20.0, 10.0).Shape();
  const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(10, 10, -1), gp_Dir(0, 0, 1)), 5, 20).Shape();
  const TopoDS_Shape bored = BRepAlgoAPI_Cut(block, hole).Shape();
  gp_Trsf mirror = translation(60, 0, 0);
  mirror.SetMirror(gp_Ax2(gp_Pnt(40, 0, 0), gp_Dir(1, 0, 0)));
  for (const TopoDS_Shape& shape :
       {bored, BRepPrimAPI_MakeTorus(20.0, 5.0).Shape(), BRepBuilderAPI_Transform(bored, mirror).Shape()}) {
    const ScratchFolder folder;
    CadWriter writer;
    writer.part("part", shape);
    ASSERT_TRUE(writer.write(folder / "a.step"));
    const Result<Assembly> step = load_assembly(folder / "a.step", {});
    ASSERT_TRUE(step.ok());
    BRepMesh_IncrementalMesh(shape, 0.01, false, 0.2);
    VrmlAPI_Writer vrml;
    vrml.SetRepresentation(VrmlAPI_ShadedRepresentation);
    vrml.Write(shape, (folder / "a.wrl").c_str(), 2);
    ImportOptions options;
    options.units = "mm";
    const Result<Assembly> read = read_vrml(folder / "a.wrl", options);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->components.size(), 1u);  // OpenCASCADE writes a Shape for each face
    expect_same_components(*step, *read, 1e-2, 0.02);
  }
}

}  // namespace
}  // namespace dismantle
