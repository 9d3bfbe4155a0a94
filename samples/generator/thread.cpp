// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/thread.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepFill.hxx>
#include <BRepLib.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <stdexcept>

namespace dismantle::samples {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Deviation of the helices' splines from the true helix [mm]: coarse, for few knots, and far below any clearance.
constexpr double kHelixTolerance = 1e-4;

using Cylinder = Handle(Geom_CylindricalSurface);

TopoDS_Edge line_on(const Cylinder& surface, gp_Pnt2d from, gp_Pnt2d to) {
  TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(GCE2d_MakeSegment(from, to).Value(), surface).Edge();
  BRepLib::BuildCurve3d(edge, kHelixTolerance);
  return edge;
}

/// A face on the cylinder bounded by straight lines in its parameters (angle, z).
TopoDS_Face polygon_on(const Cylinder& surface, const std::vector<gp_Pnt2d>& corners) {
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < corners.size(); ++i)
    wire.Add(line_on(surface, corners[i], corners[(i + 1) % corners.size()]));
  return BRepBuilderAPI_MakeFace(Handle(Geom_Surface)(surface), wire.Wire()).Face();
}

Solid closed_solid(BRepBuilderAPI_Sewing& sewing) {
  sewing.Perform();
  if (sewing.SewedShape().ShapeType() != TopAbs_SHELL || sewing.NbFreeEdges() != 0)
    throw std::logic_error("a helical skin is not closed");
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return Solid(solid);
}

/// Builds the skin of a threaded rod out of patches of half a turn, so that no patch closes on itself.
class ThreadSkin {
 public:
  ThreadSkin(const ThreadForm& form, double ridge_start, int half_turns)
      : form_(form),
        start_(ridge_start),
        half_turns_(half_turns),
        root_(new Geom_CylindricalSurface(gp_Ax3(), form.root_radius)),
        crest_(new Geom_CylindricalSurface(gp_Ax3(), form.crest_radius)),
        sewing_(1e-4) {}

  Solid build(double z0, double z1) {
    for (int i = 0; i < half_turns_; ++i) add_ridge(i);
    // The root strip beside the ridge exists where the ridge passes on both sides of it.
    for (int i = 0; i + 2 < half_turns_; ++i) sewing_.Add(patch(root_, i, ridge_width(), form_.pitch));
    add_bottom(z0);
    add_top(z1);
    add_ridge_end(0);
    add_ridge_end(half_turns_);
    return closed_solid(sewing_);
  }

 private:
  double ridge_width() const { return 2 * form_.flank_width + form_.crest_width; }
  double angle(int half_turn) const { return kPi * half_turn; }
  /// Height of the ridge's lower root edge.
  double height(int half_turn) const { return start_ + form_.pitch / 2 * half_turn; }

  TopoDS_Edge helix(const Cylinder& surface, int i, double offset) const {
    return line_on(surface, {angle(i), height(i) + offset}, {angle(i + 1), height(i + 1) + offset});
  }

  /// The strip of half a turn between two helices, `low` and `high` above the ridge's lower root edge.
  TopoDS_Face patch(const Cylinder& surface, int i, double low, double high) const {
    return polygon_on(surface, {{angle(i), height(i) + low},
                                {angle(i + 1), height(i + 1) + low},
                                {angle(i + 1), height(i + 1) + high},
                                {angle(i), height(i) + high}});
  }

  void add_ridge(int i) {
    const double low = form_.flank_width, high = low + form_.crest_width;
    sewing_.Add(patch(crest_, i, low, high));
    sewing_.Add(BRepFill::Face(helix(root_, i, 0), helix(crest_, i, low)));
    sewing_.Add(BRepFill::Face(helix(crest_, i, high), helix(root_, i, ridge_width())));
  }

  /// The flat face that cuts the ridge off, in the half plane of that half turn.
  void add_ridge_end(int i) {
    const double c = i % 2 == 0 ? 1 : -1;
    const double z = height(i), low = form_.flank_width, high = low + form_.crest_width;
    auto point = [&](double r, double dz) { return gp_Pnt(c * r, 0, z + dz); };
    BRepBuilderAPI_MakePolygon wire(point(form_.root_radius, 0), point(form_.crest_radius, low),
                                    point(form_.crest_radius, high), point(form_.root_radius, ridge_width()), true);
    sewing_.Add(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face());
  }

  void add_disc(double z) {
    BRepBuilderAPI_MakeWire wire(line_on(root_, {0, z}, {kPi, z}), line_on(root_, {kPi, z}, {2 * kPi, z}));
    sewing_.Add(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), wire.Wire()).Face());
  }

  /// The plain end below the ridge: two half cylinders up to the first turn's lower edge.
  void add_bottom(double z0) {
    const double p = form_.pitch;
    sewing_.Add(polygon_on(root_, {{0, z0}, {kPi, z0}, {kPi, start_ + p / 2}, {0, start_}}));
    sewing_.Add(polygon_on(root_, {{kPi, z0},
                                   {2 * kPi, z0},
                                   {2 * kPi, start_},
                                   {2 * kPi, start_ + ridge_width()},
                                   {2 * kPi, start_ + p},
                                   {kPi, start_ + p / 2}}));
    add_disc(z0);
  }

  /// The plain end above the ridge: two half cylinders down to the last turn's upper edge.
  void add_top(double z1) {
    const int n = half_turns_;
    const double w = ridge_width(), a = angle(n - 2), b = angle(n - 1), c = angle(n);
    sewing_.Add(polygon_on(
        root_, {{a, height(n - 2) + w}, {b, height(n - 1) + w}, {b, z1}, {a, z1}, {a, height(n) + w}, {a, height(n)}}));
    sewing_.Add(polygon_on(root_, {{b, height(n - 1) + w}, {c, height(n) + w}, {c, z1}, {b, z1}}));
    add_disc(z1);
  }

  ThreadForm form_;
  double start_;
  int half_turns_;
  Cylinder root_, crest_;
  BRepBuilderAPI_Sewing sewing_;
};

}  // namespace

ThreadForm metric_thread(double diameter, double pitch) {
  return {pitch, diameter / 2 - 0.6134 * pitch, diameter / 2, pitch / 8, pitch * 5 / 16};
}

ThreadForm trapezoidal_thread(double diameter, double pitch) {
  return {pitch, diameter / 2 - pitch / 2 - 0.15, diameter / 2, 0.366 * pitch, 0.134 * pitch};
}

ThreadForm with_play(const ThreadForm& form, double radial, double axial) {
  ThreadForm wider = form;
  wider.root_radius += radial;
  wider.crest_radius += radial;
  wider.crest_width += 2 * axial;
  return wider;
}

Solid die_spring(const SpringShape& spring) {
  const double pitch = (spring.length + spring.wire_height) / spring.turns;
  const Cylinder inner = new Geom_CylindricalSurface(gp_Ax3(), spring.inner_diameter / 2);
  const Cylinder outer = new Geom_CylindricalSurface(gp_Ax3(), spring.outer_diameter / 2);
  const int half_turns = static_cast<int>(std::lround(2 * spring.turns));
  BRepBuilderAPI_Sewing sewing(1e-4);
  auto low = [&](int i) { return pitch / 2 * i - spring.wire_height; };
  auto edge = [&](const Cylinder& surface, int i, double dz) {
    return line_on(surface, {kPi * i, low(i) + dz}, {kPi * (i + 1), low(i + 1) + dz});
  };
  for (int i = 0; i < half_turns; ++i) {
    for (const Cylinder& surface : {inner, outer})
      sewing.Add(polygon_on(surface, {{kPi * i, low(i)},
                                      {kPi * (i + 1), low(i + 1)},
                                      {kPi * (i + 1), low(i + 1) + spring.wire_height},
                                      {kPi * i, low(i) + spring.wire_height}}));
    for (const double dz : {0.0, spring.wire_height})
      sewing.Add(BRepFill::Face(edge(inner, i, dz), edge(outer, i, dz)));
  }
  for (const int i : {0, half_turns}) {
    const double c = i % 2 == 0 ? 0.5 : -0.5, z = low(i);
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(c * spring.inner_diameter, 0, z), gp_Pnt(c * spring.outer_diameter, 0, z),
                                    gp_Pnt(c * spring.outer_diameter, 0, z + spring.wire_height),
                                    gp_Pnt(c * spring.inner_diameter, 0, z + spring.wire_height), true);
    sewing.Add(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face());
  }
  const Solid wound = closed_solid(sewing);
  return wound & rod(2 * spring.outer_diameter, 0, spring.length);
}

Solid threaded_rod(const ThreadForm& form, double z0, double z1, double lead_in, double lead_out) {
  const double ridge_width = 2 * form.flank_width + form.crest_width;
  const double room = z1 - lead_out - (z0 + lead_in) - ridge_width;
  const int half_turns = static_cast<int>(std::floor(room / (form.pitch / 2)));
  if (half_turns < 2) throw std::logic_error("a thread has no room for one turn");
  return ThreadSkin(form, z0 + lead_in, half_turns).build(z0, z1);
}

}  // namespace dismantle::samples
