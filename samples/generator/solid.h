// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>
#include <gp_XYZ.hxx>
#include <vector>

namespace dismantle::samples {

/// Where a shape goes: applied to the shape's own coordinates [mm].
using Placement = gp_Trsf;
Placement at(double x, double y, double z);
/// Right-handed turn about an axis of the frame [degrees].
Placement turn_x(double degrees);
Placement turn_y(double degrees);
Placement turn_z(double degrees);
/// Takes the z axis to the x axis: for rods along x.
Placement along_x();
/// Takes the z axis to the y axis: for rods along y.
Placement along_y();
/// Takes an outline's (x, y) to (y, z), and its extrusion along z to x: for profiles seen from the side.
Placement side_view();
/// Takes an outline's (x, y) to (x, z), and its extrusion along z to -y: for profiles seen from the front.
Placement front_view();

/// A corner of a flat outline, in the plane that the outline is drawn in [mm].
struct Corner {
  double x = 0, y = 0;
  double radius = 0;  ///< Of the fillet that rounds this corner; 0 leaves it sharp.
};
using Outline = std::vector<Corner>;

/// One closed body with planar, cylindrical, conical, spherical or spline faces [mm]; a value, cheap to copy.
/// Every operation gives exactly one valid body, or throws std::logic_error that says which step failed.
class Solid {
 public:
  /// @pre the shape holds exactly one solid.
  explicit Solid(const TopoDS_Shape& shape);
  const TopoDS_Shape& shape() const { return shape_; }
  Solid placed(const Placement& placement) const;
  /// Union; faces that lie in one surface are merged.
  Solid operator+(const Solid& other) const;
  Solid operator+(const std::vector<Solid>& others) const;
  /// This solid without the other one.
  Solid operator-(const Solid& other) const;
  Solid operator-(const std::vector<Solid>& others) const;
  /// The common part.
  Solid operator&(const Solid& other) const;

 private:
  TopoDS_Shape shape_;
};

/// Axis-parallel block between two corners.
Solid block(const gp_XYZ& low, const gp_XYZ& high);
/// Cylinder about z.
Solid rod(double diameter, double z0, double z1);
/// Cylinder about z with 45 degree chamfers at the ends that are given one.
Solid chamfered_rod(double diameter, double z0, double z1, double chamfer0, double chamfer1);
/// Hollow cylinder about z.
Solid tube(double outer_diameter, double inner_diameter, double z0, double z1);
/// Truncated cone about z.
Solid cone(double diameter0, double diameter1, double z0, double z1);
Solid ball(double diameter);
/// Ring of round section about z, centred on the plane z = 0.
Solid torus(double mean_diameter, double section_diameter);
/// The outline (radius, z), closed, turned about z; no corner has a negative radius.
Solid revolved(const Outline& profile);
/// The outline (x, y), closed, extruded along z.
Solid extruded(const Outline& outline, double z0, double z1);
/// Rectangle centred on the z axis with rounded corners, extruded along z.
Solid plate(double size_x, double size_y, double corner_radius, double z0, double z1);
/// Regular polygon with `sides` sides, `across` flats apart, about z.
Solid prism(int sides, double across, double z0, double z1);

/// The same shape at each of the placements: for patterns of holes.
std::vector<Solid> at_each(const Solid& shape, const std::vector<Placement>& placements);
/// `count` placements on a circle about z, the first at angle `first_degrees`, each turned with its angle.
std::vector<Placement> around_z(int count, double circle_diameter, double z = 0, double first_degrees = 0);
/// The four corners of a rectangle about the z axis.
std::vector<Placement> at_corners(double distance_x, double distance_y, double z = 0);

}  // namespace dismantle::samples
