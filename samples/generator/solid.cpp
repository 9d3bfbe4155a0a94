// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/solid.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet2d.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <stdexcept>
#include <string>

namespace dismantle::samples {
namespace {

constexpr double kPi = 3.14159265358979323846;

Placement turned(const gp_Dir& axis, double degrees) {
  Placement placement;
  placement.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), axis), degrees * kPi / 180);
  return placement;
}

gp_Ax2 axis_at(double z) {
  return gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1));
}

TopTools_ListOfShape list_of(const std::vector<Solid>& solids) {
  TopTools_ListOfShape list;
  for (const Solid& solid : solids) list.Append(solid.shape());
  return list;
}

Solid combined(BRepAlgoAPI_BooleanOperation&& operation, const Solid& target, const std::vector<Solid>& tools) {
  TopTools_ListOfShape arguments;
  arguments.Append(target.shape());
  const TopTools_ListOfShape tool_list = list_of(tools);
  operation.SetArguments(arguments);
  operation.SetTools(tool_list);
  operation.Build();
  if (operation.HasErrors()) throw std::logic_error("a boolean operation failed");
  return Solid(operation.Shape());
}

bool has_spline_face(const TopoDS_Shape& shape) {
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    if (BRepAdaptor_Surface(TopoDS::Face(faces.Current())).GetType() == GeomAbs_BSplineSurface) return true;
  return false;
}

/// Merges neighbouring faces of one surface. Helical skins stay as they are: OpenCASCADE 7.6 does not come back from
/// merging the patches of a thread.
Solid with_merged_faces(const Solid& solid) {
  if (has_spline_face(solid.shape())) return solid;
  ShapeUpgrade_UnifySameDomain unify(solid.shape());
  unify.Build();
  return Solid(unify.Shape());
}

/// The outline as a face in the plane spanned by x and `up`, its corners rounded.
TopoDS_Face face_of(const Outline& outline, const gp_XYZ& up, double z) {
  auto point = [&](const Corner& c) { return gp_Pnt(gp_XYZ(c.x, 0, 0) + up * c.y + gp_XYZ(0, 0, z)); };
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < outline.size(); ++i)
    wire.Add(BRepBuilderAPI_MakeEdge(point(outline[i]), point(outline[(i + 1) % outline.size()])).Edge());
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();

  BRepFilletAPI_MakeFillet2d rounding(face);
  bool any = false;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(face, TopAbs_VERTEX, vertices);
  for (const Corner& corner : outline) {
    if (corner.radius <= 0) continue;
    for (int i = 1; i <= vertices.Extent(); ++i) {
      const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(i));
      if (BRep_Tool::Pnt(vertex).Distance(point(corner)) > 1e-9) continue;
      rounding.AddFillet(vertex, corner.radius);
      any = true;
    }
  }
  if (!any) return face;
  rounding.Build();
  if (!rounding.IsDone()) throw std::logic_error("an outline's corners cannot be rounded");
  return TopoDS::Face(rounding.Shape());
}

}  // namespace

Placement at(double x, double y, double z) {
  Placement placement;
  placement.SetTranslation(gp_Vec(x, y, z));
  return placement;
}
Placement turn_x(double degrees) {
  return turned(gp_Dir(1, 0, 0), degrees);
}
Placement turn_y(double degrees) {
  return turned(gp_Dir(0, 1, 0), degrees);
}
Placement turn_z(double degrees) {
  return turned(gp_Dir(0, 0, 1), degrees);
}
Placement along_x() {
  return turn_y(90);
}
Placement along_y() {
  return turn_x(-90);
}
Placement side_view() {
  return turn_z(90) * turn_x(90);
}
Placement front_view() {
  return turn_x(90);
}

Solid::Solid(const TopoDS_Shape& shape) {
  int count = 0;
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next(), ++count) shape_ = solids.Current();
  if (count != 1) throw std::logic_error("a body fell into " + std::to_string(count) + " solids");
}

Solid Solid::placed(const Placement& placement) const {
  return Solid(BRepBuilderAPI_Transform(shape_, placement, true).Shape());
}

Solid Solid::operator+(const Solid& other) const {
  return *this + std::vector<Solid>{other};
}
Solid Solid::operator+(const std::vector<Solid>& others) const {
  return with_merged_faces(combined(BRepAlgoAPI_Fuse(), *this, others));
}
Solid Solid::operator-(const Solid& other) const {
  return *this - std::vector<Solid>{other};
}
Solid Solid::operator-(const std::vector<Solid>& others) const {
  return combined(BRepAlgoAPI_Cut(), *this, others);
}
Solid Solid::operator&(const Solid& other) const {
  return combined(BRepAlgoAPI_Common(), *this, {other});
}

Solid block(const gp_XYZ& low, const gp_XYZ& high) {
  return Solid(BRepPrimAPI_MakeBox(gp_Pnt(low), gp_Pnt(high)).Shape());
}

Solid rod(double diameter, double z0, double z1) {
  return Solid(BRepPrimAPI_MakeCylinder(axis_at(z0), diameter / 2, z1 - z0).Shape());
}

Solid chamfered_rod(double diameter, double z0, double z1, double chamfer0, double chamfer1) {
  const double r = diameter / 2;
  Outline profile{{0, z0}};
  if (chamfer0 > 0) profile.push_back({r - chamfer0, z0});
  profile.push_back({r, z0 + chamfer0});
  profile.push_back({r, z1 - chamfer1});
  if (chamfer1 > 0) profile.push_back({r - chamfer1, z1});
  profile.push_back({0, z1});
  return revolved(profile);
}

Solid tube(double outer_diameter, double inner_diameter, double z0, double z1) {
  const double outer = outer_diameter / 2, inner = inner_diameter / 2;
  return revolved({{inner, z0}, {outer, z0}, {outer, z1}, {inner, z1}});
}

Solid cone(double diameter0, double diameter1, double z0, double z1) {
  return Solid(BRepPrimAPI_MakeCone(axis_at(z0), diameter0 / 2, diameter1 / 2, z1 - z0).Shape());
}

Solid ball(double diameter) {
  return Solid(BRepPrimAPI_MakeSphere(diameter / 2).Shape());
}

Solid torus(double mean_diameter, double section_diameter) {
  return Solid(BRepPrimAPI_MakeTorus(mean_diameter / 2, section_diameter / 2).Shape());
}

Solid revolved(const Outline& profile) {
  const TopoDS_Face face = face_of(profile, gp_XYZ(0, 0, 1), 0);
  TopoDS_Shape body = BRepPrimAPI_MakeRevol(face, gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))).Shape();
  TopoDS_Solid solid = TopoDS::Solid(Solid(body).shape());
  BRepLib::OrientClosedSolid(solid);
  return Solid(solid);
}

Solid extruded(const Outline& outline, double z0, double z1) {
  const TopoDS_Face face = face_of(outline, gp_XYZ(0, 1, 0), z0);
  TopoDS_Solid solid = TopoDS::Solid(Solid(BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, z1 - z0)).Shape()).shape());
  BRepLib::OrientClosedSolid(solid);
  return Solid(solid);
}

Solid plate(double size_x, double size_y, double corner_radius, double z0, double z1) {
  const double x = size_x / 2, y = size_y / 2, r = corner_radius;
  return extruded({{-x, -y, r}, {x, -y, r}, {x, y, r}, {-x, y, r}}, z0, z1);
}

Solid prism(int sides, double across, double z0, double z1) {
  const double radius = across / 2 / std::cos(kPi / sides);
  Outline outline;
  for (int i = 0; i < sides; ++i)
    outline.push_back({radius * std::cos(2 * kPi * i / sides), radius * std::sin(2 * kPi * i / sides)});
  return extruded(outline, z0, z1);
}

std::vector<Solid> at_each(const Solid& shape, const std::vector<Placement>& placements) {
  std::vector<Solid> copies;
  for (const Placement& placement : placements) copies.push_back(shape.placed(placement));
  return copies;
}

std::vector<Placement> around_z(int count, double circle_diameter, double z, double first_degrees) {
  std::vector<Placement> placements;
  for (int i = 0; i < count; ++i)
    placements.push_back(turn_z(first_degrees + 360.0 * i / count) * at(circle_diameter / 2, 0, z));
  return placements;
}

std::vector<Placement> at_corners(double distance_x, double distance_y, double z) {
  const double x = distance_x / 2, y = distance_y / 2;
  return {at(-x, -y, z), at(x, -y, z), at(x, y, z), at(-x, y, z)};
}

}  // namespace dismantle::samples
