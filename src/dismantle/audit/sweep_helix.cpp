// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/sweep_helix.h"

#include "dismantle/audit/follow_triangles.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// Descends two profile trees and follows the triangle pairs that may meet.
class HelixSweep {
 public:
  HelixSweep(const PairSweep& pair, const HelicalPair& helical, const SegmentRun& segments)
      : pair_(pair),
        helical_(helical),
        segments_(segments),
        from_(angle_at(segments.first)),
        to_(angle_at(segments.first + segments.count)),
        margin_(2 * pair.rounding + helical.motion.deviation),
        follower_(pair) {}

  TriangleFindings run() {
    visit(0, 0);
    return follower_.take();
  }

 private:
  /// The angle by which b has turned at the start of a segment [rad].
  double angle_at(std::uint32_t segment) const { return helical_.motion.angles[segment - helical_.motion.run.first]; }

  /// True if the two are never nearer to each other than the margin, whatever the angle of b.
  bool profiles_apart(const ProfileNode& a, const ProfileNode& b) const {
    const double radius = std::min(a.r.low, b.r.low);
    for (int k = 0; k < ProfileFrame::kDirections; ++k) {
      const double circumference = helical_.frame.circumference[k];
      if (gap(a.along[k], b.along[k], circumference) > helical_.frame.max_difference(k, margin_, radius)) return true;
    }
    return false;
  }

  /// Calls visit(from, to) for the ranges of b's angle in which the two may be near each other, until it returns false.
  template <class Visit>
  void for_each_passage(const ProfileNode& a, const ProfileNode& b, const Visit& visit) const {
    double first = from_, last = to_;
    const double pitch = helical_.motion.pitch;
    const double below = a.z.low - b.z.high() - margin_, above = a.z.high() - b.z.low + margin_;
    if (pitch == 0) {
      if (below > 0 || above < 0) return;
    } else {
      first = std::max(first, std::min(below / pitch, above / pitch) - kRounding);
      last = std::min(last, std::max(below / pitch, above / pitch) + kRounding);
    }
    if (first > last) return;
    const double radius = std::min(a.r.low, b.r.low);
    const double off = radius > 2 * margin_ ? 2 * margin_ / radius : kTurn;
    const double half = (a.theta.width + b.theta.width) / 2 + off + kRounding;
    if (2 * half >= kTurn) {
      visit(first, last);
      return;
    }
    const double meeting = a.theta.middle() - b.theta.middle();
    for (double turn = std::ceil((first - half - meeting) / kTurn);; ++turn) {
      const double middle = meeting + turn * kTurn;
      if (middle - half > last || !visit(std::max(first, middle - half), std::min(last, middle + half))) return;
    }
  }

  /// True if triangles of the two may come within the margin of each other.
  bool meet(const ProfileNode& a, const ProfileNode& b) const {
    if (gap(a.r, b.r, 0) > margin_) return false;
    bool some = false;
    for_each_passage(a, b, [&](double, double) {
      some = true;
      return false;
    });
    return some && !profiles_apart(a, b);
  }

  /// The smallest width of a node in the profile, of those along the frame's directions.
  static double thickness(const ProfileNode& node) {
    double width = node.r.width;
    for (const Arc& arc : node.along) width = std::min(width, arc.width);
    return width;
  }
  /// The length of a node along the thread.
  static double extent(const ProfileNode& node) { return node.z.width + node.theta.width * node.r.high(); }

  static bool splits_a(const ProfileNode& a, const ProfileNode& b) {
    if (a.leaf() || b.leaf()) return b.leaf();
    const double thickness_a = thickness(a), thickness_b = thickness(b);
    if (std::max(thickness_a, thickness_b) > 2 * std::min(thickness_a, thickness_b)) return thickness_a > thickness_b;
    return extent(a) >= extent(b);
  }

  void visit(std::uint32_t a, std::uint32_t b) {
    const ProfileNode& node_a = helical_.a.node(a);
    const ProfileNode& node_b = helical_.b.node(b);
    if (!meet(node_a, node_b)) return;
    if (node_a.leaf() && node_b.leaf()) {
      follow(node_a, node_b);
    } else if (splits_a(node_a, node_b)) {
      visit(a + 1, b);
      visit(node_a.right, b);
    } else {
      visit(a, b + 1);
      visit(a, node_b.right);
    }
  }

  /// Follows two triangles through all of their passages.
  void follow(const ProfileNode& a, const ProfileNode& b) {
    for_each_passage(a, b, [&](double from, double to) {
      const std::vector<double>& angles = helical_.motion.angles;
      const std::uint32_t start = helical_.motion.run.first;
      const auto begin = angles.begin() + (segments_.first - start);
      const auto end = begin + segments_.count;
      // The first segment that ends no earlier than the passage begins.
      auto at = std::lower_bound(begin + 1, end, from) - 1;
      for (; at < end && *at <= to; ++at) {
        const auto segment = static_cast<std::uint32_t>(at - angles.begin()) + start;
        if (!follower_.is_active(segment, 1)) continue;
        const double angle = at[1] - at[0];
        ScrewStretch stretch{segment, 0, 1, {}};
        if (angle > 0) {
          stretch.from = std::clamp((from - at[0]) / angle - kRounding, 0.0, 1.0);
          stretch.to = std::clamp((to - at[0]) / angle + kRounding, 0.0, 1.0);
        }
        stretch.a_from_b = pair_.motions[segment].at(stretch.from);
        axis_ = follower_.follow(stretch, a.face, b.face, axis_);
      }
      return true;
    });
  }

  /// Bound of the rounding of angles and times.
  static constexpr double kRounding = 1e-9;

  const PairSweep& pair_;
  const HelicalPair& helical_;
  const SegmentRun segments_;
  const double from_, to_;  // angles of b at the start and at the end [rad]
  const double margin_;
  TriangleFollower follower_;
  Vec3 axis_;  // the last certified axis, of this pair of triangles or the one before it
};

}  // namespace

std::optional<HelicalPair> helical_pair(const PairSweep& pair, const SegmentRun& run) {
  const std::optional<HelicalMotion> motion = helical_motion(pair, run);
  if (!motion) return std::nullopt;
  const ProfileFrame frame = profile_frame(pair, *motion);
  return HelicalPair{*motion, frame, ProfileTree(*pair.a, RigidTransform{}, *motion, frame),
                     ProfileTree(*pair.b, pair.motions[run.first].start, *motion, frame)};
}

TriangleFindings sweep_helix(const PairSweep& pair, const HelicalPair& helical, const SegmentRun& segments) {
  return HelixSweep(pair, helical, segments).run();
}

}  // namespace dismantle::audit
