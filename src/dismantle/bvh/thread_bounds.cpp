// SPDX-License-Identifier: Apache-2.0
#include "dismantle/bvh/thread_bounds.h"

#include "dismantle/math/angle.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Bounds the rounding of coordinates about an axis, relative to the coordinates that they are computed from.
constexpr double kRounding = 1e-13;
/// Directions within this [cosine] are the same.
constexpr double kSameDirection = 0.9998;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float rounded_down(double x) {
  return -rounded_up(-x);
}

ThreadBounds unknown() {
  ThreadBounds node;
  node.max_radius = node.end = kInfinity;
  node.begin = -kInfinity;
  std::fill(std::begin(node.low), std::end(node.low), -kInfinity);
  std::fill(std::begin(node.high), std::end(node.high), kInfinity);
  return node;
}

/// A triangle in a thread's frame: the coordinates of its corners, and bounds on how far those of its other points
/// deviate from linear interpolation between the corners.
class ThreadTriangle {
 public:
  ThreadTriangle(const ThreadFrame& frame, const Triangle& triangle) : frame_(&frame) {
    double size = max_abs(frame.axis.point);
    for (int i = 0; i < 3; ++i) {
      across_[i] = frame.axis.across(triangle[i]);
      along_[i] = frame.axis.along(triangle[i]);
      size = std::max(size, max_abs(triangle[i]));
    }
    min_radius_ = std::numeric_limits<double>::infinity();
    double turned = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = across_[i], q = across_[(i + 1) % 3];
      min_radius_ = std::min(min_radius_, AxisFrame::distance_of_segment(p, q));
      turned += angle_between(p, q);
    }
    rounding_ = kRounding * size;
    // Around the axis, or too near it for angles to be accurate.
    known_ = min_radius_ > 1e3 * rounding_ && std::abs(turned) < 1;
    if (!known_) return;
    rounding_ *= 1 + std::abs(frame.lead) / min_radius_;
    const double first = frame.axis.angle(across_[0]);
    angle_[0] = 0;
    angle_[1] = angle_between(across_[0], across_[1]);
    angle_[2] = angle_between(across_[0], across_[2]);
    for (int i = 0; i < 3; ++i) {
      distance_[i] = length(across_[i]);
      axial_[i] = along_[i] - frame.lead * (first + angle_[i]) / kTurn;
    }
    bend();
  }

  /// False for a triangle around the axis or nearly on it, which cannot be bounded.
  bool known() const { return known_; }

  ThreadBounds node() const {
    ThreadBounds node = unknown();
    node.min_radius = rounded_down(min_radius_ - rounding_);
    node.max_radius = rounded_up(*std::max_element(distance_, distance_ + 3) + rounding_);
    node.begin = rounded_down(*std::min_element(along_, along_ + 3) - rounding_);
    node.end = rounded_up(*std::max_element(along_, along_ + 3) + rounding_);
    for (int k = 0; k < frame_->direction_count; ++k) {
      const ProfileDirection d = frame_->directions[k];
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (int i = 0; i < 3; ++i) {
        const double x = d.radial * distance_[i] + d.axial * axial_[i];
        low = std::min(low, x);
        high = std::max(high, x);
      }
      const double axial = std::abs(d.axial) * axial_bend_ + 2 * rounding_;
      node.low[k] = rounded_down(low - std::max(0.0, d.radial) * distance_bend_ - axial);
      node.high[k] = rounded_up(high + std::max(0.0, -d.radial) * distance_bend_ + axial);
    }
    return node;
  }

 private:
  double angle_between(Vec3 p, Vec3 q) const { return std::atan2(dot(frame_->axis.direction, cross(p, q)), dot(p, q)); }

  /// Bounds the deviation from linear interpolation. The distance from the axis is convex: over the triangle it is
  /// below the interpolated one by at most a sixth of its second derivative for the longest side, (the step around the
  /// axis)^2 / distance. The axial offset deviates by a sixth of its own second derivative, 2 (the step around) (the
  /// step outwards) / distance^2 times the lead per radian. Steps are taken at the middle of the triangle's sector;
  /// elsewhere in it they are turned by at most half the sector.
  void bend() {
    const auto [low, high] = std::minmax({angle_[0], angle_[1], angle_[2]});
    const double sine = std::sin(std::min((high - low) / 2, kTurn / 4));
    const double middle = frame_->axis.angle(across_[0]) + (low + high) / 2;
    const Vec3 out = frame_->axis.at(middle), around = cross(frame_->axis.direction, out);
    double outs[3], arounds[3], max_out = 0, max_around = 0;  // squares
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = across_[(i + 1) % 3] - across_[i];
      const double o = dot(step, out) * dot(step, out), a = dot(step, around) * dot(step, around);
      outs[i] = (1 + sine) * (o + sine * a);
      arounds[i] = (1 + sine) * (a + sine * o);
      max_out = std::max(max_out, outs[i]);
      max_around = std::max(max_around, arounds[i]);
    }
    distance_bend_ = max_around / (6 * min_radius_);
    if (!(max_around > 0)) return;
    // 2 x y <= w x^2 + y^2 / w, with the w that is best for the longest steps.
    const double w = std::sqrt(max_around / std::max(max_out, 1e-12 * max_around));
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, w * outs[i] + arounds[i] / w);
    axial_bend_ = std::abs(frame_->lead) / kTurn * largest / (6 * min_radius_ * min_radius_);
  }

  const ThreadFrame* frame_;
  Vec3 across_[3];
  double along_[3], distance_[3] = {}, angle_[3] = {}, axial_[3] = {};
  double min_radius_ = 0, rounding_ = 0, distance_bend_ = 0, axial_bend_ = 0;
  bool known_ = false;
};

bool bounded(const ThreadBounds& node) {
  return node.high[0] < kInfinity;
}

/// Widens the distances and positions of a node by those of another.
void widen(ThreadBounds& node, const ThreadBounds& other) {
  node.min_radius = std::min(node.min_radius, other.min_radius);
  node.max_radius = std::max(node.max_radius, other.max_radius);
  node.begin = std::min(node.begin, other.begin);
  node.end = std::max(node.end, other.end);
}

void extend(ThreadBounds& node, const ThreadBounds& other, const ThreadFrame& frame) {
  widen(node, other);
  if (!bounded(node) || !bounded(other)) {
    std::fill(std::begin(node.low), std::end(node.low), -kInfinity);
    std::fill(std::begin(node.high), std::end(node.high), kInfinity);
    return;
  }
  const double off = (static_cast<double>(node.low[0]) + static_cast<double>(node.high[0]) -
                      static_cast<double>(other.low[0]) - static_cast<double>(other.high[0])) /
                     2;
  const double shift = frame.period * std::round(off / frame.period);
  for (int k = 0; k < frame.direction_count; ++k) {
    const double shifted = shift * frame.directions[k].axial;
    node.low[k] = std::min(node.low[k], rounded_down(static_cast<double>(other.low[k]) + shifted));
    node.high[k] = std::max(node.high[k], rounded_up(static_cast<double>(other.high[k]) + shifted));
  }
}

}  // namespace

void ThreadFrame::add_direction(ProfileDirection direction) {
  for (int k = 0; k < direction_count; ++k)
    if (std::abs(directions[k].radial * direction.radial + directions[k].axial * direction.axial) >= kSameDirection)
      return;
  if (direction_count < kMaxDirections) directions[direction_count++] = direction;
}

ThreadBoundsList::ThreadBoundsList(const ThreadFrame& frame, Span<const Vec3> vertices, Span<const Face> faces,
                                   Span<const ObbNode> nodes)
    : slots_(nodes.size(), 0), nodes_(1, unknown()) {
  whole_ = {kInfinity, 0, kInfinity, -kInfinity, {}, {}};
  std::vector<std::uint32_t> order, waiting{0};  // a node, then all under its first child, then under its second
  order.reserve(nodes.size());
  while (!waiting.empty()) {
    order.push_back(waiting.back());
    waiting.pop_back();
    if (const ObbNode& node = nodes[order.back()]; !node.leaf())
      waiting.insert(waiting.end(), {node.child + 1, node.child});
  }
  struct Done {
    ThreadBounds node;
    std::uint32_t count = 1;
  };
  std::vector<Done> done;
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    const ObbNode& node = nodes[*i];
    if (node.leaf()) {
      const Face& f = faces[node.child];
      const ThreadTriangle triangle(frame, {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
      done.push_back({triangle.known() ? triangle.node() : unknown()});
    } else {
      const Done first = done.back();
      done.pop_back();
      extend(done.back().node, first.node, frame);
      done.back().count += first.count;
    }
    if (done.back().count < kLargeNode) continue;
    if (bounded(done.back().node)) widen(whole_, done.back().node);
    slots_[*i] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(done.back().node);
  }
}

}  // namespace dismantle
