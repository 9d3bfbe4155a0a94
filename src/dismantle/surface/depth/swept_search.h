// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/depth/moving_part_search.h"
#include "dismantle/surface/depth/swept_depth.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// Where points are at one time of a motion on which they move linearly: an affine map.
struct InterpolatedTransform {
  double time = -1;  ///< None if negative.
  Mat3 matrix;       ///< Its linear part.
  Vec3 translation;  ///< [mm]

  InterpolatedTransform() = default;
  /// The map at a time between the two transforms.
  InterpolatedTransform(const RigidTransform& start, const RigidTransform& end, double at);

  /// The place of a point [mm].
  Vec3 operator*(Vec3 own) const { return matrix * own + translation; }
  /// The places of a triangle [mm].
  Triangle operator*(const Triangle& own) const { return {{*this * own[0], *this * own[1], *this * own[2]}}; }
  /// The box around the places of the points of a box [mm].
  Aabb operator*(const Aabb& own) const;
  /// The map of points that are given along other axes, the rows of a rotation.
  InterpolatedTransform along(const Mat3& axes) const;
};

/// Searches one surface of a pair, which moves in the frame of the other shape, for points that get too deep: see
/// first_deeper(). Times are shares of the motion.
class SweptSearch {
 public:
  using Result = MovingPartSearch::Result;  ///< The outcome of a search.

  /// @param own, other must outlive this @param start, end the poses in the frame of the other shape @param is_limited
  /// false: nothing can get too deep @param known what is known of this surface; may be null
  SweptSearch(const SolidShape& own, const SolidShape& other, const RigidTransform& start, const RigidTransform& end,
              const DepthRule& rule, bool is_limited, ShallowParts* known, const KeepGoing& keep_going);

  /// Begins the search of the motion. @return where the last search of it ended
  std::optional<ShallowParts::EndedAt> begin();
  /// Notes where the search of the motion ended early.
  void note_end(const ShallowParts::EndedAt& end) {
    if (known_) known_->ended_at = end;
  }
  /// Notes a point that is too deep, for the next motion; none: nothing is.
  void note_deep(std::optional<Vec3> own) {
    if (known_) known_->deep = own;
  }

  /// True if a point of this surface is too deep at a time [mm, own frame].
  bool is_deep(Vec3 own, double time) const {
    return parts_.is_deep(own, InterpolatedTransform(start_, end_, time) * own);
  }
  /// A sampled point that is too deep at a time. @param max_pieces that the whole search may examine; bounds the
  /// number of samples
  std::optional<TimedPoint> sample(double time, std::size_t max_pieces);
  /// The same of the middles of about `faces` faces from everywhere on the surface.
  std::optional<TimedPoint> sample_evenly(double time, std::size_t faces);
  /// Some point that is too deep in [from, to]; the pieces are counted.
  Result find(double from, double to, std::size_t& pieces, std::size_t max_pieces);
  /// True if nothing gets too deep in [from, to], nearly everywhere for reasons that are known; false says nothing.
  bool is_shallow_again(double from, double to, std::size_t& pieces, std::size_t max_pieces);
  /// A point as a DeepPoint, without the time until which nothing is deep.
  DeepPoint deep_point(const TimedPoint& found, bool of_a) const;
  /// The cost of the search apart from pieces: the points sampled, and nodes and known parts by their time.
  std::size_t others() const;

 private:
  template <class Visit>
  Result search(double from, double to, const Visit& in_face);
  bool is_deep_sample(Vec3 own, Vec3 place, std::uint32_t& last);
  Result find_in_known(const MovingPart& face, std::size_t& pieces, std::size_t max_pieces);
  void keep(const MovingPart& face, std::vector<ShallowPart> parts);
  MovingPart part(const Triangle& own, std::uint32_t face, double from, double to);
  struct Placement {
    InterpolatedTransform now;       // of the surface
    InterpolatedTransform of_boxes;  // of the boxes of its tree
  };
  const Placement& at(double time);

  const SolidShape& own_;
  const SolidShape& other_;
  RigidTransform start_, end_;
  bool is_limited_;
  DepthRule rule_;
  ShallowParts* known_;
  MovingPartSearch parts_;
  std::array<Placement, 8> recent_;  // of the last times
  std::size_t next_recent_ = 0;
  std::size_t samples_ = 0;
  std::size_t visited_ = 0;  // nodes and known parts
};

}  // namespace dismantle
