// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/profile_tree.h"

#include "dismantle/audit/triangle_axes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dismantle::audit {

namespace {

constexpr double kPi = 3.14159265358979323846;
/// A node is divided along its normal while it is more than this many times as wide along it as its triangles.
constexpr double kFlat = 4;
/// Directions within this angle of r count as r [rad].
constexpr double kAlongR = 0.04;

/// The distance forward from p to q on a circle, both in [0, circumference).
double way_on_circle(double p, double q, double circumference) {
  return q < p ? q - p + circumference : q - p;
}

double on_circle(double value, double circumference) {
  const double rest = std::fmod(value, circumference);
  return rest < 0 ? rest + circumference : rest;
}

Arc full_circle(double circumference) {
  return {0, circumference};
}

/// The distance of the origin from a triangle's projection on the plane of x and y; 0 inside.
double distance_from_axis(const std::array<Vec3, 3>& p) {
  double distance = 1e300;
  int left = 0, right = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from{p[i].x, p[i].y, 0}, to{p[(i + 1) % 3].x, p[(i + 1) % 3].y, 0};
    const Vec3 edge = to - from;
    const double squared = dot(edge, edge);
    const double s = squared > 0 ? std::clamp(-dot(from, edge) / squared, 0.0, 1.0) : 0.0;
    distance = std::min(distance, length(from + s * edge));
    const double side = from.x * to.y - from.y * to.x;
    left += side >= 0 ? 1 : 0;
    right += side <= 0 ? 1 : 0;
  }
  return left == 3 || right == 3 ? 0 : distance;
}

double angle_between(const Vec3& from, const Vec3& to) {
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

/// The angle of a triangle's normal in the plane of r and u, from r [rad].
double profile_normal(const std::array<Vec3, 3>& p) {
  const Vec3 normal = unit_normal({{p[0], p[1], p[2]}});
  const Vec3 center = (p[0] + p[1] + p[2]) / 3.0;
  const double radius = std::hypot(center.x, center.y);
  return std::atan2(normal.z, radius > 0 ? (normal.x * center.x + normal.y * center.y) / radius : 0);
}

/// A histogram of area by the angle of the normal in the profile; opposite normals count as one.
class NormalHistogram {
 public:
  static constexpr int kBins = 180;

  void add(const std::array<Vec3, 3>& p) {
    double angle = profile_normal(p);
    if (angle < 0) angle += kPi;
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    bins_[std::min(static_cast<int>(angle / kPi * kBins), kBins - 1)] += length(n);
  }

  /// Removes the most frequent direction and returns its angle [rad]. 0 and pi are the same.
  double take_peak() {
    int best = 0;
    for (int i = 1; i < kBins; ++i)
      if (near(i, kPeak) > near(best, kPeak)) best = i;
    double weight = 0, sum = 0;
    for (int k = -kPeak; k <= kPeak; ++k) {
      const double bin = bins_[wrapped(best + k)];
      weight += bin;
      sum += bin * k;
    }
    for (int k = -kTaken; k <= kTaken; ++k) bins_[wrapped(best + k)] = 0;
    return (best + 0.5 + (weight > 0 ? sum / weight : 0)) * kPi / kBins;
  }
  bool empty() const {
    return std::all_of(bins_.begin(), bins_.end(), [](double bin) { return bin == 0; });
  }

 private:
  static constexpr int kPeak = 1, kTaken = 3;
  static int wrapped(int i) { return (i + kBins) % kBins; }
  double near(int i, int reach) const {
    double sum = 0;
    for (int k = -reach; k <= reach; ++k) sum += bins_[wrapped(i + k)];
    return sum;
  }

  std::array<double, kBins> bins_{};
};

/// The coordinates of a triangle's corners about the axis of the motion.
std::array<Vec3, 3> corners_about_axis(const HelicalMotion& motion, const Triangle& t) {
  return {motion.axis_coordinates(t[0]), motion.axis_coordinates(t[1]), motion.axis_coordinates(t[2])};
}

/// The bounds of a triangle in r, z, theta and the profile.
ProfileNode bounds_of(const std::array<Vec3, 3>& p, const ProfileFrame& frame) {
  ProfileNode node;
  double radius[3], angle[3];
  for (int i = 0; i < 3; ++i) radius[i] = std::hypot(p[i].x, p[i].y);
  const double nearest = distance_from_axis(p);
  const auto [low_z, high_z] = std::minmax({p[0].z, p[1].z, p[2].z});
  node.r = make_arc(nearest, std::max({radius[0], radius[1], radius[2]}), 0);
  node.z = make_arc(low_z, high_z, 0);
  node.along[0] = node.r;

  double longest = 0;  // edge perpendicular to the axis, squared
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = p[(i + 1) % 3] - p[i];
    longest = std::max(longest, edge.x * edge.x + edge.y * edge.y);
  }
  // Linear interpolation of f over a triangle has an error of at most |f''| R^2 / 2, R^2 a third of the longest edge
  // squared (Waldron 1998); |r''| = 1 / r, r is convex, and |theta''| = 1 / r^2.
  const double off_r = longest / (6 * nearest), off_theta = off_r / nearest;
  if (!(off_theta < kPi)) {
    node.theta = full_circle(2 * kPi);
    for (int k = 1; k < ProfileFrame::kDirections; ++k) {
      const double r0 = frame.of_r[k] * node.r.low, r1 = frame.of_r[k] * node.r.high();
      const double low = std::min(r0, r1) + frame.of_u[k] * low_z, high = std::max(r0, r1) + frame.of_u[k] * high_z;
      node.along[k] = frame.pitch == 0 ? make_arc(low, high, 0) : full_circle(frame.circumference[k]);
    }
    return node;
  }
  const Vec3 center = (p[0] + p[1] + p[2]) / 3.0;
  const double middle = std::atan2(center.y, center.x);
  for (int i = 0; i < 3; ++i) angle[i] = middle + angle_between(center, p[i]);
  const auto [first, last] = std::minmax({angle[0], angle[1], angle[2]});
  node.theta = make_arc(first, last, 2 * kPi);
  for (int k = 1; k < ProfileFrame::kDirections; ++k) {
    const double of_r = frame.of_r[k], of_u = frame.of_u[k];
    double low = 1e300, high = -1e300;
    for (int i = 0; i < 3; ++i) {
      const double coordinate = of_r * radius[i] + of_u * (p[i].z - frame.pitch * angle[i]);
      low = std::min(low, coordinate);
      high = std::max(high, coordinate);
    }
    const double turning = std::fabs(frame.pitch * of_u) * off_theta;
    low -= turning + std::max(of_r, 0.0) * off_r;
    high += turning + std::max(-of_r, 0.0) * off_r;
    node.along[k] = make_arc(low, high, frame.circumference[k]);
  }
  return node;
}

}  // namespace

Arc make_arc(double low, double high, double circumference) {
  if (circumference == 0) return {low, high - low};
  if (!(high - low < circumference)) return full_circle(circumference);
  return {on_circle(low, circumference), high - low};
}

Arc united(const Arc& p, const Arc& q, double circumference) {
  if (p.width < 0) return q;
  if (q.width < 0) return p;
  if (circumference == 0) {
    const double low = std::min(p.low, q.low);
    return {low, std::max(p.high(), q.high()) - low};
  }
  const double to_q = way_on_circle(p.low, q.low, circumference), to_p = way_on_circle(q.low, p.low, circumference);
  const double from_p = std::max(p.width, to_q + q.width), from_q = std::max(q.width, to_p + p.width);
  if (!(std::min(from_p, from_q) < circumference)) return full_circle(circumference);
  return from_p <= from_q ? Arc{p.low, from_p} : Arc{q.low, from_q};
}

double gap(const Arc& p, const Arc& q, double circumference) {
  if (circumference == 0) return std::max(q.low - p.high(), p.low - q.high());
  return std::min(way_on_circle(p.low, q.low, circumference) - p.width,
                  way_on_circle(q.low, p.low, circumference) - q.width);
}

ProfileFrame::ProfileFrame(double pitch_of_motion, const std::array<double, kDirections - 1>& angles)
    : pitch(pitch_of_motion) {
  for (int k = 0; k < kDirections; ++k) {
    of_r[k] = k == 0 ? 1 : std::cos(angles[k - 1]);
    of_u[k] = k == 0 ? 0 : std::sin(angles[k - 1]);
    circumference[k] = 2 * kPi * std::fabs(pitch) * of_u[k];
  }
}

double ProfileFrame::max_difference(int k, double distance, double radius) const {
  if (k == 0 || pitch == 0) return distance;
  const double nearest = radius - distance;
  if (!(nearest > 0)) return 1e300;
  const double slope = of_u[k] * pitch / nearest;
  return distance * (1 + slope * slope / 2);  // more than the square root of 1 + slope^2
}

ProfileFrame profile_frame(const PairMotion& pair, const HelicalMotion& motion) {
  const RigidTransform& start = pair.motions[motion.run.first].start;
  NormalHistogram histogram;
  Arc r;
  for (std::uint32_t f = 0; f < pair.b->face_count(); ++f) {
    const std::array<Vec3, 3> corners = corners_about_axis(motion, transformed(start, pair.b->triangle(f)));
    for (const Vec3& p : corners) r = united(r, {std::hypot(p.x, p.y), 0}, 0);
    histogram.add(corners);
  }
  for (std::uint32_t f = 0; f < pair.a->face_count(); ++f) {
    const std::array<Vec3, 3> corners = corners_about_axis(motion, pair.a->triangle(f));
    Arc of_face;
    for (const Vec3& p : corners) of_face = united(of_face, {std::hypot(p.x, p.y), 0}, 0);
    if (gap(of_face, r, 0) <= 0) histogram.add(corners);
  }
  std::array<double, ProfileFrame::kDirections - 1> angles;
  for (int k = 0; k < ProfileFrame::kDirections - 1; ++k) {
    angles[k] = (k + 1) * kPi / ProfileFrame::kDirections;
    while (!histogram.empty()) {
      const double peak = histogram.take_peak();
      if (peak < kAlongR || peak > kPi - kAlongR) continue;  // the first direction
      angles[k] = peak;
      break;
    }
  }
  return {motion.pitch, angles};
}

struct ProfileTree::Builder {
  const ProfileFrame& frame;
  std::vector<ProfileNode> faces;
  // The direction of each face's normal in the profile: k, or k + kDirections for its opposite.
  std::vector<int> facing;
  std::vector<std::uint32_t> order;
  std::vector<ProfileNode> nodes;

  int facing_of(const std::array<Vec3, 3>& p) const {
    const double angle = profile_normal(p);
    int best = 0;
    double largest = -2;
    for (int k = 0; k < ProfileFrame::kDirections; ++k) {
      const double along = frame.of_r[k] * std::cos(angle) + frame.of_u[k] * std::sin(angle);
      if (std::fabs(along) <= largest) continue;
      largest = std::fabs(along);
      best = along >= 0 ? k : k + ProfileFrame::kDirections;
    }
    return best;
  }

  void unite(ProfileNode& node, const ProfileNode& other) const {
    node.r = united(node.r, other.r, 0);
    node.z = united(node.z, other.z, 0);
    node.theta = united(node.theta, other.theta, 2 * kPi);
    for (int k = 0; k < ProfileFrame::kDirections; ++k)
      node.along[k] = united(node.along[k], other.along[k], frame.circumference[k]);
  }

  /// Partitions order[first, first + count) into the two children.
  void halve(std::uint32_t first, std::uint32_t count, const ProfileNode& node) {
    const auto begin = order.begin() + first, middle = begin + count / 2, end = begin + count;
    const auto by = [&](const auto& key) {
      std::nth_element(begin, middle, end, [&](std::uint32_t f, std::uint32_t g) {
        const double key_f = key(f), key_g = key(g);
        return key_f != key_g ? key_f < key_g : f < g;
      });
    };
    const auto same = [&](std::uint32_t f) { return facing[f] == facing[*begin]; };
    if (!std::all_of(begin, end, same)) return by([&](std::uint32_t f) { return static_cast<double>(facing[f]); });

    const int k = facing[*begin] % ProfileFrame::kDirections;
    double own = 0;
    for (auto it = begin; it != end; ++it) own += faces[*it].along[k].width / count;
    const auto position = [&](const Arc& arc, const Arc& whole, double circumference) {
      return circumference == 0 ? arc.middle() : way_on_circle(whole.low, arc.low, circumference) + arc.width / 2;
    };
    if (node.along[k].width > kFlat * own && node.along[k].width > 0)
      return by([&](std::uint32_t f) { return position(faces[f].along[k], node.along[k], frame.circumference[k]); });
    if (node.theta.width * node.r.high() > node.z.width)
      return by([&](std::uint32_t f) { return position(faces[f].theta, node.theta, 2 * kPi); });
    return by([&](std::uint32_t f) { return faces[f].z.middle(); });
  }

  std::uint32_t build(std::uint32_t first, std::uint32_t count) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(faces[order[first]]);
    nodes.back().face = order[first];
    if (count == 1) return index;
    ProfileNode node = nodes.back();
    for (std::uint32_t i = first + 1; i < first + count; ++i) unite(node, faces[order[i]]);
    halve(first, count, node);
    nodes[index] = node;
    build(first, count / 2);
    const std::uint32_t right = build(first + count / 2, count - count / 2);
    nodes[index].right = right;
    return index;
  }
};

ProfileTree::ProfileTree(const std::vector<Triangle>& triangles, const HelicalMotion& motion,
                         const ProfileFrame& frame) {
  Builder builder{frame, {}, {}, {}, {}};
  const auto count = static_cast<std::uint32_t>(triangles.size());
  builder.order.resize(count);
  std::iota(builder.order.begin(), builder.order.end(), 0u);
  for (const Triangle& t : triangles) {
    const std::array<Vec3, 3> corners = corners_about_axis(motion, t);
    builder.faces.push_back(bounds_of(corners, frame));
    builder.facing.push_back(builder.facing_of(corners));
  }
  builder.nodes.reserve(2 * triangles.size());
  builder.build(0, count);
  nodes_ = std::move(builder.nodes);
}

}  // namespace dismantle::audit
