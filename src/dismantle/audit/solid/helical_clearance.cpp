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
/// A bound in the plane of r and u is the tighter the smaller a triangle: parts of faces are quartered so many times.
constexpr int kMaxQuarterings = 3;
/// Largest number of parts that are compared.
constexpr std::size_t kMaxParts = 400000;
/// Normals that differ by less than this count once [cosine].
constexpr double kSameDirection = 0.99;
/// Bound of the rounding of angles [rad].
constexpr double kAngleRounding = 1e-9;

/// Finds the triangles of one tree that may meet a triangle of another one during a helical motion.
class ProfileMeeting {
 public:
  /// @param turns the first tree is of the component that moves, else the second
  ProfileMeeting(const ProfileTree& tree, const ProfileTree& other, const HelicalMotion& motion,
                 const ProfileFrame& frame, bool turns, double margin)
      : tree_(tree), other_(other), motion_(motion), frame_(frame), turns_(turns), margin_(margin) {}

  /// True for each of the triangles in question that may come within the margin of one of the others.
  std::vector<bool> run(const std::vector<bool>& in_question) {
    met_.assign(in_question.size(), false);
    done_.assign(2 * in_question.size() - 1, false);
    for (std::size_t i = done_.size(); i-- > 0;) {
      const ProfileNode& node = tree_.node(static_cast<std::uint32_t>(i));
      done_[i] = node.leaf() ? !in_question[node.face] : done_[i + 1] && done_[node.right];
    }
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
  std::vector<bool> met_, done_;  // triangles that meet, and nodes of which all that are in question do
};

/// A part of a face.
struct FacePart {
  std::uint32_t face = 0;  // of its body
  Triangle corners;        // at the begin of the run, in the frame of a
  bool open = true;        // it is not known to be clear
};

void add_quarters(const FacePart& part, std::vector<FacePart>& to) {
  const Triangle& t = part.corners;
  const Vec3 m[3] = {(t[0] + t[1]) / 2.0, (t[1] + t[2]) / 2.0, (t[2] + t[0]) / 2.0};
  to.push_back({part.face, {{t[0], m[0], m[2]}}, part.open});
  to.push_back({part.face, {{m[0], t[1], m[1]}}, part.open});
  to.push_back({part.face, {{m[2], m[1], t[2]}}, part.open});
  to.push_back({part.face, {{m[0], m[1], m[2]}}, part.open});
}

std::vector<Triangle> corners_of(const std::vector<FacePart>& parts) {
  std::vector<Triangle> triangles;
  triangles.reserve(parts.size());
  for (const FacePart& part : parts) triangles.push_back(part.corners);
  return triangles;
}

/// How a part is shifted: into its own component along its normal or the mean normal at the nearest corner, or out.
enum class Retraction { Back, BackAtCorner, Forth };

/// The sum of the different outward normals of the faces at each vertex, of unit length.
std::vector<Vec3> normals_at_corners(const SolidBody& solid) {
  const AuditBody& surface = solid.surface();
  std::vector<std::vector<Vec3>> normals(surface.vertex_count());
  for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
    const Vec3 normal = solid.orientation() * unit_normal(surface.triangle(f));
    for (const std::uint32_t v : surface.face(f).v) {
      const auto same = [&](Vec3 other) { return dot(normal, other) > kSameDirection; };
      if (std::none_of(normals[v].begin(), normals[v].end(), same)) normals[v].push_back(normal);
    }
  }
  std::vector<Vec3> sums(normals.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    for (const Vec3& normal : normals[v]) sums[v] += normal;
    sums[v] = normalized(sums[v]);
  }
  return sums;
}

/// The search for clear faces of a pair.
class HelicalClearance {
 public:
  HelicalClearance(const DepthPair& pair, const HelicalMotion& motion, double limit)
      : pair_(pair),
        motion_(motion),
        frame_(profile_frame(pair.motion, motion)),
        start_(pair.motion.motions[motion.run.first].start),
        most_(std::max(limit - 2 * pair.motion.rounding, 0.0)) {
    // A copy is by `most_` further from the centre than its body.
    margin_ = motion.deviation * (1 + most_ / pair.b->surface().node(0).reach) + 2 * pair.motion.rounding;
    for (const bool of_b : {false, true}) near_[of_b] = all_faces(of_b);
    separate();
    // Overlapping faces meet in every quarter, but not as shifted copies: these are tried before faces are quartered.
    retract();
    int level = 0;
    for (; level < kMaxQuarterings && quarter(); ++level) separate();
    if (level > 0) retract();
  }

  /// The faces of which all parts, or shifted copies of them, are apart from the other component, and outside.
  std::vector<bool> clear_faces(bool of_b) const {
    std::vector<bool> clear(body(of_b).face_count(), true);
    for (const std::vector<FacePart>* parts : {&near_[of_b], &apart_[of_b]})
      for (const FacePart& part : *parts)
        if (part.open) clear[part.face] = false;
    return clear;
  }

 private:
  const AuditBody& body(bool of_b) const { return (of_b ? pair_.b : pair_.a)->surface(); }

  std::vector<FacePart> all_faces(bool of_b) const {
    std::vector<FacePart> parts;
    for (std::uint32_t f = 0; f < body(of_b).face_count(); ++f) {
      const Triangle t = body(of_b).triangle(f);
      parts.push_back({f, of_b ? transformed(start_, t) : t, true});
    }
    return parts;
  }

  /// Sorts out the open parts that are apart from those of the other component; those that are outside are clear.
  void separate() {
    if (near_[0].empty() || near_[1].empty()) return;
    const ProfileTree trees[2] = {{corners_of(near_[0]), motion_, frame_}, {corners_of(near_[1]), motion_, frame_}};
    for (const bool of_b : {false, true}) {
      std::vector<bool> open;
      for (const FacePart& part : near_[of_b]) open.push_back(part.open);
      const std::vector<bool> meets =
          ProfileMeeting(trees[of_b], trees[!of_b], motion_, frame_, of_b, margin_).run(open);
      std::vector<FacePart> near;
      for (std::size_t i = 0; i < meets.size(); ++i) {
        FacePart& part = near_[of_b][i];
        const bool is_apart = part.open && !meets[i];
        if (is_apart) part.open = inside(of_b, part.corners);
        (is_apart ? apart_[of_b] : near).push_back(part);
      }
      near_[of_b] = std::move(near);
    }
  }

  /// Quarters all parts that may meet, where some are open and they are not too many. @return false where it did not
  bool quarter() {
    const auto is_open = [](const FacePart& part) { return part.open; };
    const auto any_open = [&](const std::vector<FacePart>& parts) {
      return std::any_of(parts.begin(), parts.end(), is_open);
    };
    if (!any_open(near_[0]) && !any_open(near_[1])) return false;
    if (near_[0].size() + near_[1].size() > kMaxParts / 4) return false;
    for (std::vector<FacePart>& near : near_) {
      const std::vector<FacePart> whole = std::move(near);
      near.clear();
      for (const FacePart& part : whole) add_quarters(part, near);
    }
    return true;
  }

  /// Finds the open parts of which shifted copies are clear.
  void retract() {
    if (most_ <= 0) return;
    for (const bool of_b : {false, true}) {
      std::vector<FacePart*> open;
      for (std::vector<FacePart>* parts : {&near_[of_b], &apart_[of_b]})
        for (FacePart& part : *parts)
          if (part.open) open.push_back(&part);
      std::vector<FacePart> others = apart_[!of_b];
      others.insert(others.end(), near_[!of_b].begin(), near_[!of_b].end());
      if (open.empty() || others.empty()) continue;
      const ProfileTree other(corners_of(others), motion_, frame_);
      const std::vector<Vec3> corner_normals = normals_at_corners(of_b ? *pair_.b : *pair_.a);
      for (const Retraction way : {Retraction::Back, Retraction::BackAtCorner, Retraction::Forth})
        open = still_open(of_b, std::move(open), other, way, corner_normals);
    }
  }

  /// True if the middle of a triangle, in the frame of a at the begin, is inside the other component.
  bool inside(bool of_b, const Triangle& t) const {
    const Vec3 center = (t[0] + t[1] + t[2]) / 3.0;
    return of_b ? pair_.a->inside(center) : pair_.b->inside(inverse(start_) * center);
  }

  /// The unit vector along which a part is shifted, in the frame of its body.
  Vec3 direction(bool of_b, const FacePart& part, Retraction way, const std::vector<Vec3>& corner_normals) const {
    const SolidBody& points = of_b ? *pair_.b : *pair_.a;
    const Triangle face = points.surface().triangle(part.face);
    if (way != Retraction::BackAtCorner)
      return (way == Retraction::Forth ? 1 : -1) * points.orientation() * unit_normal(face);
    const Vec3 center = (part.corners[0] + part.corners[1] + part.corners[2]) / 3.0;
    const Vec3 at = of_b ? inverse(start_) * center : center;
    int nearest = 0;
    for (int k = 1; k < 3; ++k)
      if (length_squared(face[k] - at) < length_squared(face[nearest] - at)) nearest = k;
    return -corner_normals[points.surface().face(part.face).v[nearest]];
  }

  /// Tries one copy of each part. @return the parts that stay open
  std::vector<FacePart*> still_open(bool of_b, std::vector<FacePart*> parts, const ProfileTree& other, Retraction way,
                                    const std::vector<Vec3>& corner_normals) const {
    if (parts.empty()) return parts;
    std::vector<Triangle> copies;
    for (const FacePart* part : parts) {
      const Vec3 shift = most_ * direction(of_b, *part, way, corner_normals);
      copies.push_back(part->corners);
      for (int k = 0; k < 3; ++k) copies.back()[k] += of_b ? start_.rotation * shift : shift;
    }
    const ProfileTree tree(copies, motion_, frame_);
    const std::vector<bool> meets =
        ProfileMeeting(tree, other, motion_, frame_, of_b, margin_).run(std::vector<bool>(copies.size(), true));
    std::vector<FacePart*> open;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i]->open = meets[i] || inside(of_b, copies[i]);
      if (parts[i]->open) open.push_back(parts[i]);
    }
    return open;
  }

  const DepthPair& pair_;
  const HelicalMotion& motion_;
  ProfileFrame frame_;
  RigidTransform start_;
  double most_;
  double margin_ = 0;
  std::vector<FacePart> near_[2];   // of a, of b: those that may come within the margin of each other
  std::vector<FacePart> apart_[2];  // the others
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
