// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/helical_clearance.h"

#include "dismantle/audit/motion/profile_tree.h"
#include "dismantle/audit/triangle_axes.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// An advance along the axis by less than this part of the limit counts as none.
constexpr double kFlatPart = 1e-3;
/// Bound of the rounding of angles [rad].
constexpr double kAngleRounding = 1e-9;

/// Finds the triangles of one tree that may meet a triangle of another one during a helical motion.
class ProfileMeeting {
 public:
  /// @param turns the first tree is of the component that moves, else the second
  ProfileMeeting(const ProfileTree& tree, const ProfileTree& other, const HelicalMotion& motion,
                 const ProfileFrame& frame, bool turns, double margin)
      : tree_(tree), other_(other), motion_(motion), frame_(frame), turns_(turns), margin_(margin) {}

  /// True for each of `count` triangles that may come within the margin of one of the others.
  std::vector<bool> run(std::size_t count) {
    met_.assign(count, false);
    done_.assign(2 * count, false);
    visit(0, 0);
    return std::move(met_);
  }

 private:
  /// True if the two are never nearer to each other than the margin, whatever the angle.
  bool profiles_apart(const ProfileNode& p, const ProfileNode& q) const {
    const double radius = std::min(p.r.low, q.r.low);
    for (int k = 0; k < ProfileFrame::kDirections; ++k)
      if (gap(p.along[k], q.along[k], frame_.circumference[k]) > frame_.max_difference(k, margin_, radius)) return true;
    return false;
  }

  /// True if the moving node b passes node a at some angle of the run.
  bool passes(const ProfileNode& a, const ProfileNode& b) const {
    double first = 0, last = motion_.angles.back();
    const double below = a.z.low - b.z.high() - margin_, above = a.z.high() - b.z.low + margin_;
    if (motion_.pitch == 0) {
      if (below > 0 || above < 0) return false;
    } else {
      const double from = below / motion_.pitch, to = above / motion_.pitch;
      first = std::max(first, std::min(from, to) - kAngleRounding);
      last = std::min(last, std::max(from, to) + kAngleRounding);
    }
    if (first > last) return false;
    const double radius = std::min(a.r.low, b.r.low);
    const double off = radius > 2 * margin_ ? 2 * margin_ / radius : kTurn;
    const double half = (a.theta.width + b.theta.width) / 2 + off + kAngleRounding;
    if (2 * half >= kTurn) return true;
    const double meeting = a.theta.middle() - b.theta.middle();
    return meeting + std::ceil((first - half - meeting) / kTurn) * kTurn - half <= last;
  }

  bool meet(const ProfileNode& p, const ProfileNode& q) const {
    if (gap(p.r, q.r, 0) > margin_) return false;
    return (turns_ ? passes(q, p) : passes(p, q)) && !profiles_apart(p, q);
  }

  /// The smallest width of a node in the profile, of those along the frame's directions.
  static double thickness(const ProfileNode& node) {
    double width = node.r.width;
    for (const Arc& arc : node.along) width = std::min(width, arc.width);
    return width;
  }
  /// The length of a node along the thread.
  static double extent(const ProfileNode& node) { return node.z.width + node.theta.width * node.r.high(); }

  static bool splits_first(const ProfileNode& p, const ProfileNode& q) {
    if (p.leaf() || q.leaf()) return q.leaf();
    const double thickness_p = thickness(p), thickness_q = thickness(q);
    if (std::max(thickness_p, thickness_q) > 2 * std::min(thickness_p, thickness_q)) return thickness_p > thickness_q;
    return extent(p) >= extent(q);
  }

  void visit(std::uint32_t i, std::uint32_t j) {
    const ProfileNode& p = tree_.node(i);
    const ProfileNode& q = other_.node(j);
    if (done_[i] || !meet(p, q)) return;
    if (p.leaf() && q.leaf()) {
      met_[p.face] = done_[i] = true;
    } else if (splits_first(p, q)) {
      visit(i + 1, j);
      visit(p.right, j);
      done_[i] = done_[i + 1] && done_[p.right];
    } else {
      visit(i, j + 1);
      visit(i, q.right);
    }
  }

  const ProfileTree& tree_;
  const ProfileTree& other_;
  const HelicalMotion& motion_;
  const ProfileFrame& frame_;
  const bool turns_;
  const double margin_;
  std::vector<bool> met_, done_;  // triangles that meet, and nodes all of which meet
};

/// The search for clear faces of a pair.
class HelicalClearance {
 public:
  HelicalClearance(const DepthPair& pair, const HelicalMotion& motion, double limit)
      : pair_(pair),
        motion_(motion),
        frame_(profile_frame(pair.motion, motion)),
        start_(pair.motion.motions[motion.run.first].start),
        most_(limit - 2 * pair.motion.rounding) {
    // A copy is by `most_` further from the centre than its body.
    margin_ = motion.deviation * (1 + most_ / pair.b->surface().node(0).reach) + 2 * pair.motion.rounding;
  }

  std::vector<bool> clear_faces(bool of_b) const {
    const SolidBody& points = of_b ? *pair_.b : *pair_.a;
    const SolidBody& solid = of_b ? *pair_.a : *pair_.b;
    const ProfileTree other(triangles(!of_b), motion_, frame_);
    std::vector<bool> clear(points.surface().face_count(), false);
    for (const double part : {0.0, -1.0, 1.0}) {
      std::vector<std::uint32_t> faces;
      for (std::uint32_t f = 0; f < clear.size(); ++f)
        if (!clear[f]) faces.push_back(f);
      if (faces.empty() || (part != 0 && !(most_ > 0))) break;
      std::vector<Vec3> shifts(clear.size());
      for (const std::uint32_t f : faces)
        shifts[f] = part * most_ * points.orientation() * unit_normal(points.surface().triangle(f));
      const std::vector<Triangle> copies = triangles(of_b, shifts, faces);
      const ProfileTree tree(copies, motion_, frame_);
      const std::vector<bool> met = ProfileMeeting(tree, other, motion_, frame_, of_b, margin_).run(copies.size());
      const RigidTransform solid_from_a = of_b ? RigidTransform{} : inverse(start_);
      for (std::size_t i = 0; i < faces.size(); ++i) {
        const Vec3 center = (copies[i][0] + copies[i][1] + copies[i][2]) / 3.0;
        clear[faces[i]] = !met[i] && !solid.inside(solid_from_a * center);
      }
    }
    return clear;
  }

 private:
  /// The faces at the begin of the run, shifted, in the frame of a.
  std::vector<Triangle> triangles(bool of_b, const std::vector<Vec3>& shifts,
                                  const std::vector<std::uint32_t>& faces) const {
    const AuditBody& body = of_b ? pair_.b->surface() : pair_.a->surface();
    std::vector<Triangle> made;
    for (const std::uint32_t f : faces) {
      Triangle t = body.triangle(f);
      for (int k = 0; k < 3; ++k) t[k] = of_b ? start_ * (t[k] + shifts[f]) : t[k] + shifts[f];
      made.push_back(t);
    }
    return made;
  }

  /// All faces, not shifted.
  std::vector<Triangle> triangles(bool of_b) const {
    const std::uint32_t count = (of_b ? pair_.b : pair_.a)->surface().face_count();
    std::vector<std::uint32_t> faces(count);
    for (std::uint32_t f = 0; f < count; ++f) faces[f] = f;
    return triangles(of_b, std::vector<Vec3>(count), faces);
  }

  const DepthPair& pair_;
  const HelicalMotion& motion_;
  ProfileFrame frame_;
  RigidTransform start_;
  double most_;
  double margin_ = 0;
};

}  // namespace

std::optional<ClearFaces> clear_in_helical_motion(const DepthPair& pair, const SegmentRun& run, double limit) {
  if (!pair.a->closed() || !pair.b->closed()) return std::nullopt;
  const std::optional<HelicalMotion> motion = helical_motion(pair.motion, run, kFlatPart * limit);
  if (!motion) return std::nullopt;
  const HelicalClearance clearance(pair, *motion, limit);
  return ClearFaces{clearance.clear_faces(false), clearance.clear_faces(true)};
}

}  // namespace dismantle::audit
