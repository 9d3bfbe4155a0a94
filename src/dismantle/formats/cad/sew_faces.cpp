// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/sew_faces.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <vector>

namespace dismantle {

namespace {

/// A closed shell as a solid, any other one as it is.
TopoDS_Shape solid_if_closed(const TopoDS_Shell& shell) {
  if (!BRep_Tool::IsClosed(shell)) return shell;
  TopoDS_Solid solid;
  const BRep_Builder builder;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return BRepLib::OrientClosedSolid(solid) ? TopoDS_Shape(solid) : TopoDS_Shape(shell);
}

}  // namespace

TopoDS_Shape sew_loose_faces(const TopoDS_Shape& shape, double tolerance, CadProduct& colors) {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer face(shape, TopAbs_FACE, TopAbs_SOLID); face.More(); face.Next())
    faces.push_back(face.Current());
  if (faces.empty()) return shape;

  BRepBuilderAPI_Sewing sewing(tolerance);
  for (const TopoDS_Shape& face : faces) sewing.Add(face);
  sewing.Perform();
  for (const TopoDS_Shape& face : faces) {
    const Color* color = colors.subshape_colors.Seek(face.Located(TopLoc_Location()));
    if (color == nullptr) continue;
    const Color copy = *color;  // Bind may move it
    colors.subshape_colors.Bind(sewing.Modified(face).Located(TopLoc_Location()), copy);
  }

  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) builder.Add(result, solid.Current());
  const TopoDS_Shape& sewn = sewing.SewedShape();
  if (sewn.IsNull()) return shape;
  for (TopExp_Explorer shell(sewn, TopAbs_SHELL); shell.More(); shell.Next())
    builder.Add(result, solid_if_closed(TopoDS::Shell(shell.Current())));
  for (TopExp_Explorer face(sewn, TopAbs_FACE, TopAbs_SHELL); face.More(); face.Next()) {
    TopoDS_Shell alone;  // a sphere, say, is closed by itself
    builder.MakeShell(alone);
    builder.Add(alone, face.Current());
    const TopoDS_Shape solid = solid_if_closed(alone);
    builder.Add(result, solid.ShapeType() == TopAbs_SOLID ? solid : face.Current());
  }
  return result;
}

}  // namespace dismantle
