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

/// The motion of the moving component in the fixed one's frame, in double: between trees' frames as LinearSweep has it.
struct PairMotion {
  RigidTransform t0, t1;
  Mat3 middle;  ///< The rotation half way.
  Screw back;   ///< The motion of the fixed component in the frame of the moving one's tree.
  /// The largest distance of an arc of the moving component from its chord, beyond what `allowed` leaves out for it
  /// [mm].
  double deviation = 0;
  double kept = 0;     ///< What `allowed` leaves out for arcs [mm].
  double allowed = 0;  ///< How deep triangles may be in each other on the true paths [mm].
  /// Cylinders in bores that are cylindrical to this [mm] and are not apart are told as fits; below 0: none are.
  double fit_spread = -1;
  /// So many blocked pairs are enough, or two of each part of the front; the rest may be left unlooked at.
  std::size_t enough_blocked = static_cast<std::size_t>(-1);
};

/// A whole cylinder in a whole bore: what keeps the one's axis within some distance of the other's.
struct CylinderFit {
  bool moving_inside = true;              ///< The cylinder is of the moving component, the bore of the fixed one.
  RevolutionAxis inner, outer;            ///< [mm, assembled]
  double inner_begin = 0, inner_end = 0;  ///< The cylinder between places along its axis, from the axis' point [mm],
  double outer_begin = 0, outer_end = 0;  ///< and the bore.
  double radius = 0;                      ///< Of the cylinder [mm].
  double room = 0;    ///< The two are apart while no place of the cylinder's axis in the bore is further off [mm].
  double spread = 0;  ///< Triangles may allow so much more [mm].
  friend bool operator==(const CylinderFit&, const CylinderFit&) = default;
};

/// A certificate of surfaces that turn about nearly the same axis: what is within some distance of the one axis is
/// apart from what is beyond it of the other, less how far the axes are off each other. Unlike one plane it parts a
/// whole shaft from its bore, and still does when one turns in the other or slides along it.
///
/// Proof: a triangle beyond distance r of a line lies beyond a plane that is r off the line and along it, and whose
/// normal leads from the line to the triangle's nearest point. Everything within distance s of another line, between
/// two places of it, is at most s + off in front of that plane's parallel through the first line, off being how far
/// those places are off the line along the normal. Both are so at the start and at the end of a linear motion, with the
/// plane at rest: so they are in between. Only those places count that come beside the outer triangle: the rest of the
/// inner one is past its ends, along the line, and stays there when it is moved along the normal. So moved by as much
/// as the bound is below zero the two are apart; and where it is above zero for all that is at most some way past the
/// ends, they are that way apart, or the bound.
class RadialSweep {
 public:
  /// What is proved of two nodes: their gap along planes that touch the outer one's cylinder is never less than that
  /// [mm].
  struct Gap {
    double gap = 0;
    bool facing = false;   ///< No outward normal leads away from the other along those planes' normals,
    bool face_on = false;  ///< and all lead well towards it.
  };
  /// @param least gaps below it are of no use: what is given may be far below the true one [mm]
  Gap gap(std::uint32_t moving, std::uint32_t fixed, double least) const {
    const RadialBounds &m = (*moving_)[moving], &f = (*fixed_)[fixed];
    const double moving_inside = static_cast<double>(f.least) - static_cast<double>(m.most);
    const double fixed_inside = static_cast<double>(m.least) - static_cast<double>(f.most) - fixed_bend_;
    if (std::max(moving_inside, fixed_inside) + max_off_ < least)
      return {-std::numeric_limits<double>::infinity(), false, false};
    if (moving_inside >= fixed_inside)
      return {moving_inside - moving_off_.most(m, f, moving_inside), m.clear_out && f.clear_in,
              m.faces_out && f.faces_in};
    return {fixed_inside - fixed_off_.most(f, m, fixed_inside), m.clear_in && f.clear_out, m.faces_in && f.faces_out};
  }

  /// What two nodes are to each other as a whole cylinder in a whole bore, if they are cylindrical to `spread` together
  /// [mm].
  std::optional<CylinderFit> fit(std::uint32_t moving, std::uint32_t fixed, double spread) const;

 private:
  friend class RadialSweeps;
  /// How far the points of one axis are off the other, at both ends of the motion.
  struct Off {
    Vec3 at[2];            ///< At its own point, across the other [mm].
    Vec3 along[2];         ///< The change a mm along it.
    double beside[2];      ///< The place of its own point along the other one [mm].
    double ahead[2];       ///< The change a mm along it.
    double max_aside = 0;  ///< The sine of the largest angle between the axes.
    /// What the axes' being off each other takes at most from the room between the nodes [mm]; negative where the inner
    /// one is off the other way.
    /// @param room between the distances of the two from their axes [mm]
    double most(const RadialBounds& inner, const RadialBounds& outer, double room) const;

   private:
    /// How far the inner node's axis is off towards the outer node where the two are beside each other, or at most
    /// `past` its ends [mm].
    double toward(const RadialBounds& inner, const RadialBounds& outer, double past) const;
    /// Between which places along its axis something of the inner node may be there at some time.
    std::pair<double, double> part_beside(const RadialBounds& inner, const RadialBounds& outer, double past) const;
  };

  const RadialBoundsList* moving_ = nullptr;
  const RadialBoundsList* fixed_ = nullptr;
  const RevolutionAxis* moving_axis_ = nullptr;
  const RevolutionAxis* fixed_axis_ = nullptr;
  Off moving_off_, fixed_off_;
  double max_off_ = 0;     ///< No point of one axis that a node is at is further off the other [mm].
  double fixed_bend_ = 0;  ///< What arcs of the fixed component, as the moving one sees it, may take more [mm].
};

/// The sweeps of the axes of two components that are nearest to each other as a motion begins, a few at most; worked
/// out when first asked for. May be asked by several threads at the same time.
class RadialSweeps {
 public:
  /// @param moving_origin, fixed_origin of the trees [mm, assembled]. The shapes must outlive it.
  RadialSweeps(const RevolutionSurface& moving, Vec3 moving_origin, const RevolutionSurface& fixed, Vec3 fixed_origin,
               const PairMotion& motion)
      : moving_(&moving), fixed_(&fixed), moving_origin_(moving_origin), fixed_origin_(fixed_origin), motion_(motion) {}

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
