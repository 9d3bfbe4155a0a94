// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/surface/depth/depth_rule.h"
#include "dismantle/surface/depth/shallow_parts.h"
#include "dismantle/surface/solid_shape.h"

#include <cstddef>
#include <optional>

namespace dismantle {

/// A rigid motion of a shape `a` in the assembled frame of a shape `b`, on which every point moves linearly.
struct SweptPair {
  const SolidShape* a = nullptr;  ///< The moving shape; never null.
  const SolidShape* b = nullptr;  ///< The fixed shape; never null.
  RigidTransform start;           ///< Pose of `a` in the frame of `b` at time 0.
  RigidTransform end;             ///< At time 1.
  double until = 1;               ///< Only points that are too deep by this time are sought.
  ///@{ What is known of the surfaces of `a` and `b` from motions before, with the same limits; may be null.
  ShallowParts* known_a = nullptr;
  ShallowParts* known_b = nullptr;
  ///@}
};

/// A point that gets too deep.
struct DeepPoint {
  /// False where the search ended before it was known whether a point gets too deep: it counts as if one did.
  bool is_certain = true;
  double free_until = 0;     ///< No point is deeper than the limit before this time.
  double time = 0;           ///< The point is deeper at this time.
  bool of_a = true;          ///< It is a point of the surface of `a`, inside `b`; else of `b`, inside `a`.
  std::uint32_t face_a = 0;  ///< The face of `a` that it is on, or is nearest to.
  std::uint32_t face_b = 0;  ///< The same of `b`.
  Vec3 point;                ///< The point [mm, frame of the other shape].
  Vec3 nearest;              ///< The nearest point of the other surface [mm, in its frame].
};

/// Which point that gets too deep is sought.
enum class DeepSearch {
  First,  ///< The first one.
  Any,    ///< Any: decides if there is one.
};

/// Number of pieces after which first_deeper() gives up.
inline constexpr std::size_t kMaxSweptPieces = 400000;

/// Finds out if a point of either surface gets deeper inside the other solid than it may during a motion; depth
/// as in solid_depth(). Branch and bound over surfaces and time: what it does not find does not exist. A piece of a
/// surface stays within the limit if its corners are no further from any one triangle of the other surface than that at
/// both ends of an interval, as that distance is a convex function; if the other surface does not meet a ball around
/// the piece for so long, and its middle is outside; or if a copy of the piece that is shifted by no more than the
/// limit is outside a closed surface: a point that is inside is no deeper than the way to its copy is long. An interval
/// that takes more than `max_pieces` pieces is halved; one of a `resolution` that takes as many counts as if a point
/// had been found.
/// Once `keep_going` returns false, it counts as if a point had been found where nothing is known yet.
/// @param resolution of times: `free_until` is earlier than `time` by no more than this, if the search ends
/// @param search_for with DeepSearch::Any, `free_until` may be much earlier than `time`
/// @param cost if not null, is increased by the number of points and pieces that were examined
std::optional<DeepPoint> first_deeper(const SweptPair& pair, const DepthLimits& limits, double resolution,
                                      std::size_t max_pieces = kMaxSweptPieces, const KeepGoing& keep_going = {},
                                      DeepSearch search_for = DeepSearch::First, std::size_t* cost = nullptr);

}  // namespace dismantle
