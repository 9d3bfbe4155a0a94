// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/watched_spheres.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/math/screw.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace dismantle {

/// The first vertex that a motion takes too deep.
struct DeepVertexTime {
  double toi = 1;                           ///< All vertices are certainly allowed on [0, toi].
  std::uint32_t vertex = 0;                 ///< Of the inner component; meaningless if `face` is kNone.
  std::uint32_t face = NearestFace::kNone;  ///< The outer component's nearest face; kNone if no vertex gets too deep.
};

/// A ball without any surface of the outer component in it, in the frame of that component.
struct SurfaceFreeBall {
  Vec3 center;                                              ///< [mm]
  double clear = -std::numeric_limits<double>::infinity();  ///< Radius [mm]; negative if there is none.
  SurfaceSide side = SurfaceSide::Unknown;                  ///< The side on which all of it lies.
};

/// The last balls found. They are valid at any time of a motion, as the surface is stationary in its own frame.
class SurfaceFreeBalls {
 public:
  /// Keeps a ball, in place of the oldest.
  void add(const SurfaceFreeBall& ball) { last_[next_++ % last_.size()] = ball; }
  /// The side of a point, if the ball around it meets a kept one: then no surface lies between the centers.
  /// @param clear lower bound of the distance from the point to the surface [mm]
  SurfaceSide side_of(Vec3 point, double clear) const;

 private:
  std::array<SurfaceFreeBall, 8> last_;
  std::size_t next_ = 0;
};

/// Outcome of a motion for the vertices in one sphere.
struct SphereOutcome {
  std::vector<WatchedSphere> start;  ///< Spheres that replace it before the motion.
  std::vector<WatchedSphere> end;    ///< Spheres that replace it after the motion, if no vertex gets too deep.
  DeepVertexTime deep;               ///< When a vertex first gets too deep, if one does.
};

/// The motion of an inner component relative to an outer one: one screw, along which the vertices of the inner one are
/// followed by conservative advancement of their slacks.
class VertexMotion {
 public:
  /// @param component must outlive this
  /// @param start, end x_outer = start * x_inner, both assembled
  VertexMotion(const WatchedComponent& component, const RigidTransform& start, const RigidTransform& end);

  /// Upper bound of the path of every vertex in the node's sphere [mm].
  double path_length(const VertexNode& node) const { return path_length(component_.sphere(node)); }
  /// Upper bound of the path of every vertex [mm].
  double max_path_length() const { return path_length(component_.tree->root()); }
  /// Follows the vertices of a sphere through the whole motion.
  /// @param w known before the motion
  /// @param known balls found for other spheres; those found for this one are added
  SphereOutcome follow(const WatchedSphere& w, SurfaceFreeBalls& known) const;

 private:
  double path_length(const VertexSphere& sphere) const;
  void follow(WatchedSphere w, double at, SurfaceFreeBalls& known, SphereOutcome& outcome) const;
  Vec3 position(Vec3 from, double at) const;
  double face_distance(std::uint32_t face, Vec3 point) const;
  double allowed_by_face_until(std::uint32_t face, const VertexSphere& s, double at) const;
  WatchedSphere bounded_by_face(WatchedSphere w, Vec3 center, double radius) const;
  WatchedSphere half(const WatchedSphere& w, const VertexSphere& s, const VertexNode& node) const;
  void evaluate(WatchedSphere& w, Vec3 point, double radius, double left, const SurfaceFreeBalls& known) const;
  SurfaceSide side_of(Vec3 point, double clear, const SurfaceFreeBalls& known) const;

  const WatchedComponent& component_;
  RigidTransform start_;
  Screw screw_;
};

}  // namespace dismantle
