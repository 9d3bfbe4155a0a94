// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/rigid_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// The depth of two meshes by brute force: dense samples of both surfaces, the solid angles of all triangles, the
/// distances of all triangles. Shares no code with the library but vectors.
namespace dismantle::oracle {

/// What the samples found.
struct SampledDepth {
  double depth = 0;  ///< Of the deepest sample [mm]: a lower bound.
  Vec3 deepest_at;   ///< That sample.
  /// Every point of a surface is at most this far from a sample [mm]. With closed meshes the depth is at most the sum
  /// of both.
  double spacing = 0;
};

/// The generalised winding number at a point.
inline double winding_number(const TriangleMesh& mesh, Vec3 point) {
  double sum = 0;
  for (const Face& f : mesh.faces) {
    Vec3 u[3];
    for (int k = 0; k < 3; ++k) {
      const Vec3 r = mesh.vertices[f.v[k]] - point;
      const double l = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z);
      if (l == 0) return 0;
      u[k] = {r.x / l, r.y / l, r.z / l};
    }
    const double volume = dot(u[0], cross(u[1], u[2]));
    sum += std::atan2(volume, 1 + dot(u[0], u[1]) + dot(u[1], u[2]) + dot(u[2], u[0]));
  }
  return sum / (2 * std::acos(-1.0));
}

/// The squared distance of a point from a segment.
inline double squared_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double dd = dot(d, d);
  const double s = dd > 0 ? std::clamp(dot(p - a, d) / dd, 0.0, 1.0) : 0;
  const Vec3 r = p - (a + s * d);
  return dot(r, r);
}

/// The distance of a point from the surface of a mesh [mm].
inline double distance(const TriangleMesh& mesh, Vec3 p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Face& f : mesh.faces) {
    const Vec3 a = mesh.vertices[f.v[0]], b = mesh.vertices[f.v[1]], c = mesh.vertices[f.v[2]];
    best = std::min({best, squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)});
    const Vec3 n = cross(b - a, c - a);
    const double nn = dot(n, n);
    if (nn == 0) continue;
    const bool above =
        dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
    if (above) best = std::min(best, dot(p - a, n) * dot(p - a, n) / nn);
  }
  return std::sqrt(best);
}

/// Calls sample(point) for points of a triangle no further apart than `step` along its sides.
template <class Sample>
void for_each_sample(Vec3 a, Vec3 b, Vec3 c, double step, const Sample& sample) {
  const double side = std::max({length(b - a), length(c - b), length(a - c)});
  const int n = std::max(1, static_cast<int>(std::ceil(side / step)));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      sample(i == n ? b : j == n ? c : a + u * (b - a) + v * (c - a));
    }
}

/// Samples the surface of `inner` for its deepest point inside `outer`.
inline void sample_depth(const TriangleMesh& inner, const TriangleMesh& outer, double step, SampledDepth& found) {
  for (const Face& f : inner.faces) {
    const auto sample = [&](Vec3 p) {
      const double d = distance(outer, p);
      if (d <= found.depth || std::abs(winding_number(outer, p)) <= 0.5) return;
      found.depth = d;
      found.deepest_at = p;
    };
    for_each_sample(inner.vertices[f.v[0]], inner.vertices[f.v[1]], inner.vertices[f.v[2]], step, sample);
  }
}

/// The depth of two meshes in a common frame, by samples that are `step` [mm] apart.
inline SampledDepth sampled_depth(const TriangleMesh& a, const TriangleMesh& b, double step) {
  SampledDepth found;
  found.spacing = step / std::sqrt(3.0);
  sample_depth(a, b, step, found);
  sample_depth(b, a, step, found);
  return found;
}

}  // namespace dismantle::oracle
