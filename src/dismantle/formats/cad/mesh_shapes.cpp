// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/mesh_shapes.h"

#include "dismantle/formats/cad/shape_mesh.h"
#include "dismantle/formats/cad/stage_progress.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_TFace.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Minimum edge length relative to the deflection [1]: OpenCASCADE's default of 0.1 would keep the angular deflection
/// from refining small round features.
constexpr double kMinEdge = 1e-3;

/// A cone by the line that turns about its axis, with the same parameters; null for any other surface.
Handle(Geom_SurfaceOfRevolution) as_revolution(const Handle(Geom_Surface) & surface) {
  const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
  const auto cone = Handle(Geom_ConicalSurface)::DownCast(trimmed.IsNull() ? surface : trimmed->BasisSurface());
  if (cone.IsNull()) return {};
  const gp_Ax3 frame = cone->Position();
  const double angle = cone->SemiAngle();
  const gp_Vec along = std::sin(angle) * gp_Vec(frame.XDirection()) + std::cos(angle) * gp_Vec(frame.Direction());
  const gp_Ax1 axis = frame.Direct() ? frame.Axis() : frame.Axis().Reversed();
  return new Geom_SurfaceOfRevolution(new Geom_Line(cone->Value(0, 0), gp_Dir(along)), axis);
}

/// Replaces the surface of a face by one with the same parameters.
void replace_surface(const TopoDS_Face& face, const Handle(Geom_Surface) & surface, const TopLoc_Location& location) {
  struct Curves {
    TopoDS_Edge edge;
    Handle(Geom2d_Curve) first, second;  // a seam has two
    double begin = 0, end = 0;
  };
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  std::vector<Curves> all;
  for (TopExp_Explorer edges(forward, TopAbs_EDGE); edges.More(); edges.Next()) {
    Curves curves;
    curves.edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
    curves.first = BRep_Tool::CurveOnSurface(curves.edge, forward, curves.begin, curves.end);
    if (BRep_Tool::IsClosed(curves.edge, forward))
      curves.second =
          BRep_Tool::CurveOnSurface(TopoDS::Edge(curves.edge.Reversed()), forward, curves.begin, curves.end);
    all.push_back(curves);
  }
  const BRep_Builder builder;
  for (const Curves& curves : all) {
    if (curves.first.IsNull()) continue;
    const double tolerance = BRep_Tool::Tolerance(curves.edge);
    if (curves.second.IsNull()) {
      builder.UpdateEdge(curves.edge, curves.first, surface, location, tolerance);
    } else {
      builder.UpdateEdge(curves.edge, curves.first, curves.second, surface, location, tolerance);
    }
    builder.Range(curves.edge, surface, location, curves.begin, curves.end);
  }
  Handle(BRep_TFace)::DownCast(face.TShape())->Surface(surface);
}

/// Makes surfaces of revolution of the conical faces of a shape. @return true if there are any
bool replace_cones(const TopoDS_Shape& shape) {
  bool replaced = false;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current());
    TopLoc_Location location;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(face.Located({})), location);
    const Handle(Geom_SurfaceOfRevolution) revolution = as_revolution(surface);
    if (revolution.IsNull()) continue;
    replace_surface(TopoDS::Face(face.Located({})), revolution, location);
    replaced = true;
  }
  return replaced;
}

/// True if a shape's triangles leave something out.
bool is_incomplete(const TopoDS_Shape& shape) {
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    TopLoc_Location location;
    if (BRep_Tool::Triangulation(TopoDS::Face(faces.Current()), location).IsNull()) return true;
  }
  return clean_mesh(mesh_from_shape(shape)).faults.open_edges > 0;
}

}  // namespace

void mesh_shapes(const std::vector<TopoDS_Shape>& shapes, double deflection, double angle,
                 const ProgressCallback& progress) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) {
    BRepTools::Clean(shape);  // a file may hold triangles of another deflection
    builder.Add(all, shape);
  }

  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection;
  parameters.Angle = angle;
  parameters.MinSize = std::max(kMinEdge * deflection, Precision::Confusion());
  parameters.InParallel = true;
  const auto mesh = [&] {
    BRepMesh_IncrementalMesh mesher;
    mesher.SetShape(all);
    mesher.ChangeParameters() = parameters;
    const Handle(StageProgress) indicator = new StageProgress(progress, "meshing");
    mesher.Perform(indicator->Start());
  };
  mesh();
  bool replaced = false;
  for (const TopoDS_Shape& shape : shapes) {
    if (!is_incomplete(shape) || !replace_cones(shape)) continue;
    BRepTools::Clean(shape);  // so that neighbours have the same points on their common edges
    replaced = true;
  }
  if (replaced) mesh();  // the other shapes keep their triangles
}

}  // namespace dismantle
