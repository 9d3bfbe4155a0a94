// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/radial_bounds.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// The motion of a moving component in the frame of a fixed one, in double precision; between their trees' frames like
/// LinearSweep.
struct PairMotion {
  RigidTransform t0;  ///< The transform at the start.
  RigidTransform t1;  ///< The transform at the end.
  Mat3 middle;        ///< The rotation half way.
  Screw back;         ///< The motion of the fixed component in the frame of the moving one's tree.
  /// The largest distance of an arc of the moving component from its chord, less `kept` [mm].
  double deviation = 0;
  double kept = 0;     ///< Share of the allowance that is reserved for arcs, not contained in `allowed` [mm].
  double allowed = 0;  ///< Allowed penetration depth of triangles on the true paths [mm].
  /// Cylinders and bores that are not apart are reported as fits if their radial deviations sum to at most this [mm];
  /// below 0: none are.
  double max_fit_deviation = -1;
  /// The sweep may stop after this many blocked pairs, or two of each part of the front.
  std::size_t max_blocked = static_cast<std::size_t>(-1);
};

/// A whole cylinder in a whole bore, as one contact: limits the distance between the two axes.
struct CylinderFit {
  bool moving_inside = true;    ///< The cylinder is of the moving component, the bore of the fixed one.
  RevolutionAxis inner;         ///< Axis of the cylinder [mm, assembled].
  RevolutionAxis outer;         ///< Axis of the bore [mm, assembled].
  double inner_begin = 0;       ///< Start of the cylinder along its axis, from the axis' point [mm].
  double inner_end = 0;         ///< End of the cylinder [mm].
  double outer_begin = 0;       ///< Start of the bore along its axis [mm].
  double outer_end = 0;         ///< End of the bore [mm].
  double radius = 0;            ///< Radius of the cylinder [mm].
  double room = 0;              ///< The two are apart while the axes, inside the bore, are no further apart [mm].
  double radial_deviation = 0;  ///< The triangles may allow this much more room [mm].
  friend bool operator==(const CylinderFit&, const CylinderFit&) = default;
};

/// Separation of surfaces of revolution with nearly the same axis: everything within some radius about the one axis is
/// apart from everything beyond that radius about the other, less the distance between the axes. Unlike one plane it
/// separates a whole shaft from its bore, also while one turns in the other or slides along it.
///
/// Proof: a triangle beyond distance r of a line lies beyond a plane that is parallel to the line at distance r, with
/// the normal from the line to the triangle's nearest point. Everything within distance s of another line, between two
/// points of it, is at most s + off in front of that plane's parallel through the first line, where off is the largest
/// distance of those points from the first line along the normal. Both hold at the start and at the end of a linear
/// motion with the plane at rest, hence in between. Only those points count that lie beside the outer triangle: the
/// rest of the inner node is past its ends, along the line, and stays there when it is moved along the normal. So the
/// two are apart when they are moved apart by minus the bound, if the bound is negative; if it is positive for all that
/// is at most some distance past the ends, they are apart by that distance or the bound.
class RadialSweep {
 public:
  /// Lower bound of the gap of two nodes during the motion, along the planes that touch the outer one's cylinder [mm].
  /// @param min_gap smaller gaps are of no use: the result may then be far below the true one [mm]
  double gap(std::uint32_t moving, std::uint32_t fixed, double min_gap) const {
    const RadialBounds &m = (*moving_)[moving], &f = (*fixed_)[fixed];
    const double moving_inside = static_cast<double>(f.min_radius) - static_cast<double>(m.max_radius);
    const double fixed_inside = static_cast<double>(m.min_radius) - static_cast<double>(f.max_radius) - fixed_bend_;
    if (std::max(moving_inside, fixed_inside) + max_off_ < min_gap) return -std::numeric_limits<double>::infinity();
    return moving_inside >= fixed_inside ? moving_inside - moving_off_.upper_bound(m, f, moving_inside)
                                         : fixed_inside - fixed_off_.upper_bound(f, m, fixed_inside);
  }

  /// Two nodes as a whole cylinder in a whole bore; none if they are not, or their radial deviations sum to more than
  /// `max_deviation` [mm].
  std::optional<CylinderFit> fit(std::uint32_t moving, std::uint32_t fixed, double max_deviation) const;

 private:
  friend class RadialSweeps;
  /// The offset of one axis from the other, at both ends of the motion.
  struct Off {
    Vec3 at[2];            ///< Offset of its own point, across the other axis [mm].
    Vec3 along[2];         ///< Change of the offset per mm along the axis.
    double beside[2];      ///< Position of its own point along the other axis [mm].
    double ahead[2];       ///< Change of that position per mm along the axis.
    double max_aside = 0;  ///< Sine of the largest angle between the axes.
    /// Upper bound of how much of the room between the nodes the offset takes [mm]; negative if the inner node is
    /// offset away from the outer one.
    /// @param room between the radii of the two nodes [mm]
    double upper_bound(const RadialBounds& inner, const RadialBounds& outer, double room) const;

   private:
    /// The largest offset of the inner node's axis towards the outer node, where the two are beside each other or at
    /// most `past` its ends [mm].
    double toward(const RadialBounds& inner, const RadialBounds& outer, double past) const;
    /// The range along its axis in which some of the inner node may be beside the outer one at some time.
    std::pair<double, double> part_beside(const RadialBounds& inner, const RadialBounds& outer, double past) const;
  };

  const RadialBoundsList* moving_ = nullptr;
  const RadialBoundsList* fixed_ = nullptr;
  const RevolutionAxis* moving_axis_ = nullptr;
  const RevolutionAxis* fixed_axis_ = nullptr;
  Off moving_off_, fixed_off_;
  double max_off_ = 0;     ///< Upper bound of all offsets within the extent of the nodes [mm].
  double fixed_bend_ = 0;  ///< Additional deviation of the fixed component's arcs in the moving one's frame [mm].
};

/// The radial sweeps of two components: one for each of the few pairs of axes that are nearest to each other at the
/// start of the motion. Computed on first use; thread-safe.
class RadialSweeps {
 public:
  /// The surfaces must outlive the sweeps.
  /// @param moving_origin, fixed_origin origins of the trees [mm, assembled]
  RadialSweeps(const RevolutionSurface& moving, Vec3 moving_origin, const RevolutionSurface& fixed, Vec3 fixed_origin,
               const PairMotion& motion)
      : moving_(&moving), fixed_(&fixed), moving_origin_(moving_origin), fixed_origin_(fixed_origin), motion_(motion) {}

  /// The sweeps, the nearest axes first.
  Span<const RadialSweep> get() const;

 private:
  struct AxisPair {
    std::size_t moving, fixed;
    double off;
  };
  std::vector<AxisPair> nearest_pairs() const;
  RadialSweep sweep(const AxisPair& pair) const;

  const RevolutionSurface* moving_;
  const RevolutionSurface* fixed_;
  Vec3 moving_origin_, fixed_origin_;
  PairMotion motion_;
  mutable std::once_flag once_;
  mutable std::vector<RadialSweep> sweeps_;
};

}  // namespace dismantle
