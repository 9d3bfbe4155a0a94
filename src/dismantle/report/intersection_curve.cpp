// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/intersection_curve.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace dismantle {

namespace {

struct BoxedFace {
  std::uint32_t face;
  Aabb box;
};

Aabb box_of(const Triangle& t) {
  Aabb box;
  for (const Vec3& corner : t.corner) box.extend(corner);
  return box;
}

/// The faces whose boxes overlap `region`, sorted by the lower ends of the boxes along `axis`.
std::vector<BoxedFace> faces_within(const TriangleMesh& mesh, const Aabb& region, int axis) {
  std::vector<BoxedFace> faces;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Aabb box = box_of(mesh.triangle(f));
    if (overlaps(box, region)) faces.push_back({f, box});
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [axis](const BoxedFace& p, const BoxedFace& q) { return p.box.lower[axis] < q.box.lower[axis]; });
  return faces;
}

/// The point where the segment p-q crosses the triangle, if it does.
std::optional<Vec3> crossing(Vec3 p, Vec3 q, const Triangle& t) {
  const Vec3 n = normal_unscaled(t);
  const double above_p = dot(n, p - t[0]), above_q = dot(n, q - t[0]);
  if ((above_p > 0) == (above_q > 0) || above_p == above_q) return std::nullopt;
  const Vec3 x = p + above_p / (above_p - above_q) * (q - p);
  for (int k = 0; k < 3; ++k)
    if (dot(n, cross(t[(k + 1) % 3] - t[k], x - t[k])) < 0) return std::nullopt;
  return x;
}

/// The intersection of two triangles: the two edge crossings that are farthest apart.
std::optional<CurveSegment> cut_of(const Triangle& a, const Triangle& b) {
  std::vector<Vec3> points;
  for (int k = 0; k < 3; ++k) {
    if (const auto x = crossing(a[k], a[(k + 1) % 3], b)) points.push_back(*x);
    if (const auto x = crossing(b[k], b[(k + 1) % 3], a)) points.push_back(*x);
  }
  std::optional<CurveSegment> longest;
  double length_of_longest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double l = length_squared(points[j] - points[i]);
      if (l <= length_of_longest) continue;
      length_of_longest = l;
      longest = CurveSegment{{points[i], points[j]}};
    }
  }
  return longest;
}

}  // namespace

std::vector<CurveSegment> intersection_curve(const TriangleMesh& a, const TriangleMesh& b) {
  const Aabb box_a = bounds(a), box_b = bounds(b);
  const Aabb region{max(box_a.lower, box_b.lower), min(box_a.upper, box_b.upper)};
  if (region.empty()) return {};
  const Vec3 size = region.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;

  struct Found {
    std::uint32_t a, b;
    CurveSegment segment;
  };
  std::vector<Found> found;
  const auto try_pair = [&](const BoxedFace& f, const BoxedFace& g) {
    if (!overlaps(f.box, g.box)) return;
    if (const auto segment = cut_of(a.triangle(f.face), b.triangle(g.face)))
      found.push_back({f.face, g.face, *segment});
  };
  // Sweep and prune: of two boxes that overlap along the axis, one contains the lower end of the other.
  const std::vector<BoxedFace> faces_a = faces_within(a, region, axis), faces_b = faces_within(b, region, axis);
  std::size_t i = 0, j = 0;
  while (i < faces_a.size() && j < faces_b.size()) {
    if (faces_a[i].box.lower[axis] <= faces_b[j].box.lower[axis]) {
      for (std::size_t k = j; k < faces_b.size() && faces_b[k].box.lower[axis] <= faces_a[i].box.upper[axis]; ++k)
        try_pair(faces_a[i], faces_b[k]);
      ++i;
    } else {
      for (std::size_t k = i; k < faces_a.size() && faces_a[k].box.lower[axis] <= faces_b[j].box.upper[axis]; ++k)
        try_pair(faces_a[k], faces_b[j]);
      ++j;
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Found& p, const Found& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  std::vector<CurveSegment> curve;
  curve.reserve(found.size());
  for (const Found& f : found) curve.push_back(f.segment);
  return curve;
}

}  // namespace dismantle
