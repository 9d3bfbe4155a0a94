// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/congruence.h"
#include "dismantle/math/mat3.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace dismantle {

namespace {

/// Vertices of `a` and `b` are both rounded, so that they differ by twice the deviation of one.
constexpr double kBoth = 2;
/// Rounding of sums of many numbers, relative.
constexpr double kSums = 1e-9;

/// The largest and the smallest eigenvalue of a symmetric matrix.
std::pair<double, double> extreme_eigenvalues(const Mat3& m) {
  const double mean = (m.row[0].x + m.row[1].y + m.row[2].z) / 3;
  Mat3 off = m;
  for (int i = 0; i < 3; ++i) off.row[i][i] -= mean;
  const double square = length_squared(off.row[0]) + length_squared(off.row[1]) + length_squared(off.row[2]);
  const double p = std::sqrt(square / 6);
  if (!(p > 0)) return {mean, mean};
  const double angle = std::acos(std::clamp(determinant(off) / (2 * p * p * p), -1.0, 1.0)) / 3;
  return {mean + 2 * p * std::cos(angle), mean + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3)};
}

bool are_near(double a, double b, double play) {
  return std::abs(a - b) <= play + kSums * (std::abs(a) + std::abs(b));
}

}  // namespace

MeshInvariants mesh_invariants(const TriangleMesh& mesh) {
  MeshInvariants found;
  found.vertices = mesh.vertices.size();
  found.faces = mesh.faces.size();
  if (mesh.vertices.empty()) return found;
  for (const Vec3& p : mesh.vertices) {
    found.center += p / static_cast<double>(found.vertices);
    found.reach = std::max(found.reach, length(p));
  }
  Mat3 moments{{{}, {}, {}}};
  for (const Vec3& p : mesh.vertices) {
    const Vec3 from = p - found.center;
    found.distances.push_back(length(from));
    for (int i = 0; i < 3; ++i) moments.row[i] += (from[i] / static_cast<double>(found.vertices)) * from;
  }
  std::sort(found.distances.begin(), found.distances.end());
  found.mean_square = moments.row[0].x + moments.row[1].y + moments.row[2].z;
  std::tie(found.largest_moment, found.smallest_moment) = extreme_eigenvalues(moments);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 normal = normal_unscaled(t);
    found.area += length(normal) / 2;
    found.volume += dot(t[0] - found.center, normal) / 6;
    found.edge_length += length(t[1] - t[0]) + length(t[2] - t[1]) + length(t[0] - t[2]);
  }
  return found;
}

double area_play(const MeshInvariants& a) {
  // A triangle whose corners move by d changes its area by at most half its perimeter times d, to first order.
  return kBoth * kCongruenceTolerance * a.reach * a.edge_length + kSums * a.area;
}

bool may_be_congruent(const MeshInvariants& a, const MeshInvariants& b) {
  if (a.vertices != b.vertices || a.faces != b.faces || a.vertices == 0) return false;
  const double play = kBoth * kCongruenceTolerance * std::max(a.reach, b.reach);
  const double radius = std::max(a.distances.back(), b.distances.back());
  if (!are_near(a.area, b.area, std::max(area_play(a), area_play(b)))) return false;
  if (!are_near(a.volume, b.volume, play * std::max(a.area, b.area))) return false;
  const double moment_play = 2 * play * radius + play * play;
  if (!are_near(a.mean_square, b.mean_square, moment_play) ||
      !are_near(a.largest_moment, b.largest_moment, moment_play) ||
      !are_near(a.smallest_moment, b.smallest_moment, moment_play))
    return false;
  for (std::size_t i = 0; i < a.distances.size(); ++i)
    if (!are_near(a.distances[i], b.distances[i], play)) return false;
  return true;
}

}  // namespace dismantle
