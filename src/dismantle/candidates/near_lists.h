// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/core/span.h"
#include "dismantle/geometry/triangle.h"
#include "dismantle/math/vec3.h"
#include "dismantle/narrowphase/separating_axis.h"

#include <limits>

namespace dismantle {

/// A translation, as bounds of its first contacts take it.
struct StraightMotion {
  Vec3 displacement;    ///< [mm, world]
  double distance = 0;  ///< Its length, and more than 0 [mm].

  /// @param d the displacement [mm, world]
  DISMANTLE_HOST_DEVICE explicit StraightMotion(Vec3 d)
      : displacement(d), distance(length(d) > 1e-300 ? length(d) : 1e-300) {}
};

/// An axis that separates two objects at the start. A *closing rate* is the inverse of a lower bound of the fraction of
/// a translation after which they may meet: below 1 they do not meet.
struct SeparatingAxis {
  Vec3 normal;  ///< From the stationary object to the moving one, divided by the gap [1/mm].
  /// Share of the translation's length, or of a position, that covers rounding [1/mm]; infinite without an axis.
  double slack = std::numeric_limits<double>::infinity();

  /// False if no axis was found.
  DISMANTLE_HOST_DEVICE bool separates() const { return slack < std::numeric_limits<double>::infinity(); }
  /// The rate along this axis.
  DISMANTLE_HOST_DEVICE double closing_rate(const StraightMotion& motion) const {
    return slack * motion.distance - dot(motion.displacement, normal);
  }
  /// Lower bound of the gap of the moving triangle where it has moved to, as a share of that at the start.
  /// @param level of the stationary object @pre separates()
  DISMANTLE_HOST_DEVICE double gap_left(const Triangle& moved, double level) const {
    double left = std::numeric_limits<double>::infinity();
    for (const Vec3& p : moved.corner) {
      const Vec3 size = absolute(p);
      const double above = dot(normal, p) - slack * (size.x + size.y + size.z);
      left = above < left ? above : left;
    }
    return left - level;
  }
};

/// Two axes of a triangle and a ghost.
struct AxisPair {
  SeparatingAxis axes[2];  ///< The same twice where there is one.

  /// The lower of the two rates.
  DISMANTLE_HOST_DEVICE double closing_rate(const StraightMotion& motion) const {
    const double first = axes[0].closing_rate(motion), second = axes[1].closing_rate(motion);
    return first < second ? first : second;
  }
};

/// Two leaves that are near each other at the start: the first moves. They meet where the ghost of one meets the other.
struct NearLeaves {
  NodePair leaves;           ///< Of the moving set and of a stationary component.
  double gap = 0;            ///< Lower bound of both distances [mm].
  AxisPair of_moving_ghost;  ///< The widest gaps between the ghost of the moving triangle and the other triangle.
  AxisPair of_fixed_ghost;   ///< Those between the moving triangle and the ghost of the stationary one.
};

/// More axes of NearLeaves, for those that the others do not decide: the normals of the triangles and the ghosts decide
/// most that slide along each other. Of the other axes again where a normal does not separate.
struct NearNormals {
  ///@{ As the axes of these names.
  AxisPair of_moving_ghost, of_fixed_ghost;
  ///@}
};

/// The levels of the stationary objects along the axes of NearLeaves: upper bounds of their positions along the
/// normals.
struct NearLevels {
  ///@{ As the axes of these names.
  double of_moving_ghost[2] = {}, of_fixed_ghost[2] = {};
  ///@}
};

/// Two nodes whose leaves are not listed, as they are further away than those that are, or too many: the first moves.
struct FarNodes {
  NodePair nodes;  ///< Of the moving set and of stationary components.
  double gap = 0;  ///< Lower bound of the distance of their bounds [mm].
};

/// All that the moving set may meet on a motion from one state, found once for all motions from it. Every pair of
/// leaves that is tested is in `near` or below one of `far`.
struct NearLists {
  Span<const NearLeaves> near;      ///< By ascending gap.
  Span<const NearNormals> normals;  ///< Of the same leaves.
  Span<const NearLevels> levels;    ///< Of the same leaves.
  Span<const FarNodes> far;         ///< By ascending gap.

  /// The closing rate of near pair k: the larger one of the two with a ghost, each by its best axis.
  /// @param enough where the rate is no higher than this, no more axes are tried
  DISMANTLE_HOST_DEVICE double closing_rate(std::size_t k, const StraightMotion& motion, double enough) const {
    const double first = near[k].of_moving_ghost.closing_rate(motion);
    const double second = near[k].of_fixed_ghost.closing_rate(motion);
    if (first <= enough && second <= enough) return larger(first, second);
    return larger(lesser(first, normals[k].of_moving_ghost.closing_rate(motion)),
                  lesser(second, normals[k].of_fixed_ghost.closing_rate(motion)));
  }

  /// True if nothing that is far is met before a point of the moving set has moved so far [mm].
  DISMANTLE_HOST_DEVICE bool hold_within(double distance) const { return far.empty() || far[0].gap > distance; }

 private:
  DISMANTLE_HOST_DEVICE static double lesser(double x, double y) { return x < y ? x : y; }
  DISMANTLE_HOST_DEVICE static double larger(double x, double y) { return x > y ? x : y; }
};

}  // namespace dismantle
