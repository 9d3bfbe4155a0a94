// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/response/contact_patch.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// A triangle in coordinates along a direction: x and y across it, z along it, about a common origin.
Triangle seen_along(const Triangle& t, Vec3 origin, Vec3 right, Vec3 forward, Vec3 up) {
  Triangle seen;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = t[i] - origin;
    seen[i] = {dot(right, d), dot(forward, d), dot(up, d)};
  }
  return seen;
}

/// Cross product of the x and y parts.
double cross_flat(Vec3 a, Vec3 b) {
  return a.x * b.y - a.y * b.x;
}

/// Length of the x and y parts.
double length_flat(Vec3 a) {
  return std::sqrt(a.x * a.x + a.y * a.y);
}

/// Computes the height of the triangle at p. @return false if p is beside it by more than `slack`
bool height_at(const Triangle& t, Vec3 p, double slack, double& height) {
  const double area = cross_flat(t[1] - t[0], t[2] - t[0]);
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, length_flat(t[(i + 1) % 3] - t[i]));
  // Edge-on: the crossings of its edges suffice.
  if (std::abs(area) <= longest * slack) return false;
  height = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 from = t[(i + 1) % 3], edge = t[(i + 2) % 3] - from;
    const double part = cross_flat(edge, p - from) / area;
    const double outside = -part * std::abs(area) / std::max(length_flat(edge), 1e-300);
    if (outside > slack) return false;
    height += part * t[i].z;
  }
  return true;
}

}  // namespace

const ContactPatch::Point& ContactPatch::nearest() const {
  return *std::min_element(points, points + count, [](const Point& a, const Point& b) { return a.gap < b.gap; });
}

ContactPatch contact_patch(const Triangle& upper, const Triangle& lower, Vec3 up, double slack) {
  const Vec3 other = std::abs(up.x) <= std::abs(up.y) && std::abs(up.x) <= std::abs(up.z)
                         ? Vec3{1, 0, 0}
                         : (std::abs(up.y) <= std::abs(up.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  const Vec3 right = normalized(cross(up, other)), forward = cross(up, right), origin = upper[0];
  const Triangle a = seen_along(upper, origin, right, forward, up), b = seen_along(lower, origin, right, forward, up);

  ContactPatch patch;
  const auto add = [&](Vec3 at, double z_upper, double z_lower) {
    patch.points[patch.count++] = {origin + at.x * right + at.y * forward + z_upper * up, z_upper - z_lower};
  };
  for (int i = 0; i < 3; ++i) {
    double height = 0;
    if (height_at(b, a[i], slack, height)) add(a[i], a[i].z, height);
    if (height_at(a, b[i], slack, height)) add(b[i], height, b[i].z);
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec3 p = a[i], along_a = a[(i + 1) % 3] - p, q = b[j], along_b = b[(j + 1) % 3] - q;
      const double length_a = length_flat(along_a), length_b = length_flat(along_b);
      const double sine = cross_flat(along_a, along_b);
      // An edge seen end-on is a point: its corners count.
      if (std::abs(sine) <= 1e-9 * length_a * length_b || length_a <= slack || length_b <= slack) continue;
      const double s = cross_flat(q - p, along_b) / sine, t = cross_flat(q - p, along_a) / sine;
      const double more_a = slack / length_a, more_b = slack / length_b;
      if (s < -more_a || s > 1 + more_a || t < -more_b || t > 1 + more_b) continue;
      const Vec3 on_a = p + s * along_a;
      add(on_a, on_a.z, q.z + t * along_b.z);
    }
  return patch;
}

}  // namespace dismantle
