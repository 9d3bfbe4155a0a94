// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/facet_sagitta.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace dismantle::audit {

namespace {

/// Faces that are inclined by more are not facets of one smooth surface [rad].
constexpr double kSmooth = 0.53;

using Point = std::array<double, 3>;

Point point_of(Vec3 p) {
  return {p.x, p.y, p.z};
}

/// One side of an edge: the face's normal, and its width across the edge [mm].
struct Side {
  Vec3 normal;
  double width = 0;
};

}  // namespace

double facet_sagitta(const AuditBody& body, const Aabb& box) {
  std::map<std::pair<Point, Point>, Side> edges;
  double largest = 0;
  for (std::uint32_t f = 0; f < body.face_count(); ++f) {
    Vec3 p[3];
    Aabb around;
    for (int i = 0; i < 3; ++i) around.extend(p[i] = body.vertex(body.face(f).v[i]));
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double area = length(normal);
    if (!overlaps(around, box) || area == 0) continue;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = p[i], b = p[(i + 1) % 3];
      const Side side{normal / area, area / length(b - a)};
      const auto [known, is_new] = edges.try_emplace(std::minmax(point_of(a), point_of(b)), side);
      if (is_new) continue;
      const double angle =
          std::atan2(length(cross(side.normal, known->second.normal)), dot(side.normal, known->second.normal));
      if (angle > kSmooth) continue;
      largest = std::max(largest, std::max(side.width, known->second.width) / 2 * std::tan(angle / 4));
    }
  }
  return largest;
}

}  // namespace dismantle::audit
