// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/keep_going.h"
#include "dismantle/surface/depth/depth_rule.h"
#include "dismantle/surface/depth/part_hull.h"
#include "dismantle/surface/depth/shallow_parts.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dismantle {

/// Searches moving parts of triangles for points that are deeper inside a solid than a limit, by branch and bound: see
/// first_deeper().
class MovingPartSearch {
 public:
  /// @param solid must outlive this @param keep_going once it returns false, searches are given up; may be empty
  MovingPartSearch(const SolidShape& solid, const DepthRule& rule, const KeepGoing& keep_going = {})
      : solid_(solid), rule_(rule), keep_going_(keep_going) {}

  /// The outcome of a search.
  struct Result {
    std::optional<TimedPoint>
        found;  ///< A point that is too deep. Nothing where no point is too deep, or the search is not complete.
    bool complete = true;  ///< There were not too many pieces.
  };

  /// True if a point is too deep [mm, frame of the solid]. @param own the point in its own frame
  bool is_deep(Vec3 own, Vec3 point) const;
  /// The same of a point at a known distance from the surface [mm].
  bool is_deep(Vec3 own, Vec3 point, double distance) const;
  /// Searches a part for a point that is too deep. @param pieces is increased by the number of pieces examined; the
  /// search is given up above `max_pieces` @param shallow if not null, the parts that it was divided into are appended,
  /// with their own times; they are worth something only where nothing was found. Where the search was given up, those
  /// that are left are among them
  Result find(const MovingPart& whole, std::size_t& pieces, std::size_t max_pieces,
              std::vector<ShallowPart>* shallow = nullptr) const;
  /// True if a part stays shallow for a reason that held for it before; false says nothing.
  bool holds(const ShallowProof& known, const MovingPart& part) const;

 private:
  struct Ball;
  static Ball ball_around(const MovingPart& part);
  /// Faces from which the next searches start.
  struct NearestFaces {
    std::uint32_t of_solid = 0, of_thick = 0, of_hole = 0;
  };
  bool in_region(const MovingPart& part, LargerLimit larger) const;
  bool in_hole(const MovingPart& part, const Ball& ball, std::uint32_t face) const;
  void find_larger(const MovingPart& part, const Ball& ball, NearestFaces& last, ShallowProof& proof) const;
  bool find_proof(const MovingPart& part, const Ball& ball, const MeshDistance& nearest, NearestFaces& last,
                  ShallowProof& proof) const;
  bool is_near(const MovingPart& part) const;
  bool near_faces(const MovingPart& part, const Ball& ball, std::uint32_t nearest, double distance, double limit) const;
  bool near_thick_faces(const MovingPart& part, std::uint32_t nearest) const;
  std::optional<Vec3> copy_outside(const MovingPart& part, Vec3 center, double radius, std::uint32_t nearest,
                                   LargerLimit larger) const;
  bool is_outside(const MovingPart& part, Vec3 center, double radius, Vec3 shift, LargerLimit larger) const;
  void divide(const MovingPart& part, std::uint32_t nearest, std::vector<MovingPart>& parts) const;
  bool in_one_plane(std::uint32_t face, std::uint32_t other) const;
  bool find_ridge(const Triangle& part, std::uint32_t nearest, int& edge, double& share) const;

  const SolidShape& solid_;
  DepthRule rule_;
  KeepGoing keep_going_;
};

/// True if no point of a triangle whose corners move linearly gets deeper inside a solid than `limit` [mm]; false where
/// one does, or where more than `max_pieces` pieces would have to be examined. @param pieces is increased by the number
/// of pieces examined
bool stays_shallow(const SolidShape& solid, const Triangle& from, const Triangle& to, double limit, std::size_t& pieces,
                   std::size_t max_pieces);

}  // namespace dismantle
