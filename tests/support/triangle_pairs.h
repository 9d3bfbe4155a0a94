// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

/// Pairs of triangles that are hard for predicates. Deterministic.
namespace dismantle::scenes {

struct TrianglePair {
  Triangle a, b;
};

/// The families of pairs, from easy to nearly or exactly degenerate.
enum class PairKind {
  Random,           ///< Corners anywhere in one cube.
  Lattice,          ///< Small integer coordinates: coincidences of every kind, and triangles without area.
  LatticePlane,     ///< Integer combinations of two integer vectors: exactly coplanar, mostly not axis-aligned.
  AxisPlanes,       ///< Axis-aligned planes with decimal millimetre coordinates, as in CAD files.
  SharedCorner,     ///< One corner in common.
  SharedEdge,       ///< Two corners in common.
  CornerOnFace,     ///< A corner of one rounded onto the other's face, edge or corner.
  EdgeOnEdge,       ///< Two edges that meet in a rounded point.
  RoundedCoplanar,  ///< All corners rounded from one general plane.
  Slivers,          ///< Corners of one or both on one line, rounded.
  NoArea,           ///< One or both exactly a segment or a point, on or near the other.
  Parallel,         ///< Edges of the two parallel, or nearly.
  kCount
};

inline const char* name_of(PairKind kind) {
  constexpr const char* kNames[] = {"random",           "lattice",     "lattice_plane",  "axis_planes",
                                    "shared_corner",    "shared_edge", "corner_on_face", "edge_on_edge",
                                    "rounded_coplanar", "slivers",     "no_area",        "parallel"};
  return kNames[static_cast<int>(kind)];
}

/// Generates the pairs.
class TrianglePairs {
 public:
  explicit TrianglePairs(std::uint64_t seed) : random_(seed) {}

  TrianglePair next(PairKind kind) {
    TrianglePair pair = shape(kind);
    place(pair);
    if (chance(3)) nudge(pair);
    shuffle(pair.a);
    shuffle(pair.b);
    if (chance(2)) std::swap(pair.a, pair.b);
    return pair;
  }

 private:
  double uniform(double lower, double upper) { return std::uniform_real_distribution<double>(lower, upper)(random_); }
  int integer(int lower, int upper) { return std::uniform_int_distribution<int>(lower, upper)(random_); }
  bool chance(int one_in) { return integer(1, one_in) == 1; }

  Vec3 point() {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    return {x, y, z};
  }
  Vec3 lattice_point(int largest) {
    const int x = integer(-largest, largest), y = integer(-largest, largest), z = integer(-largest, largest);
    return {1.0 * x, 1.0 * y, 1.0 * z};
  }
  Triangle triangle() {
    const Vec3 a = point(), b = point(), c = point();
    return {{a, b, c}};
  }

  /// A convex weight, often zero or a simple fraction, so that corners and edges occur too.
  double weight() { return chance(2) ? uniform(0, 1) : integer(0, 4) / 4.0; }
  Vec3 point_on(const Triangle& t) {
    const double v = weight(), w = weight() * (1 - v);
    return t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
  }
  Vec3 point_in_plane_of(const Triangle& t) {
    const double v = uniform(-1, 2), w = uniform(-1, 2);
    return t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
  }

  TrianglePair shape(PairKind kind) {
    TrianglePair pair{triangle(), triangle()};
    Triangle& a = pair.a;
    Triangle& b = pair.b;
    switch (kind) {
      case PairKind::Lattice:
        for (int i = 0; i < 3; ++i) a[i] = lattice_point(2), b[i] = lattice_point(2);
        break;
      case PairKind::LatticePlane:
        lattice_plane(pair);
        break;
      case PairKind::AxisPlanes:
        axis_planes(pair);
        break;
      case PairKind::SharedCorner:
        b[0] = a[0];
        break;
      case PairKind::SharedEdge:
        b[0] = a[1], b[1] = a[0];
        if (chance(3)) b[2] = point_in_plane_of(a);
        break;
      case PairKind::CornerOnFace:
        b[0] = point_on(a);
        if (chance(3)) b[1] = point_on(a);
        break;
      case PairKind::EdgeOnEdge: {
        const Vec3 meeting = a[0] + weight() * (a[1] - a[0]);
        b[1] = meeting - weight() * (b[0] - meeting);
        break;
      }
      case PairKind::RoundedCoplanar:
        for (int i = 0; i < 3; ++i) b[i] = chance(3) ? point_on(a) : point_in_plane_of(a);
        break;
      case PairKind::Slivers:
        sliver(a);
        if (chance(2)) b[0] = point_on(a);
        if (chance(2)) sliver(b);
        break;
      case PairKind::NoArea:
        no_area(pair);
        break;
      case PairKind::Parallel:
        parallel(pair);
        break;
      default:
        break;
    }
    return pair;
  }

  void lattice_plane(TrianglePair& pair) {
    const Vec3 u = lattice_point(3), v = lattice_point(3), origin = lattice_point(2);
    for (Triangle* t : {&pair.a, &pair.b})
      for (Vec3& p : t->corner) p = origin + (1.0 * integer(-2, 2)) * u + (1.0 * integer(-2, 2)) * v;
    if (chance(4)) pair.b[0] += lattice_point(1);
  }

  void axis_planes(TrianglePair& pair) {
    for (Triangle* t : {&pair.a, &pair.b}) {
      const int axis = integer(0, 2);
      const double height = integer(0, 2) * 0.1;
      for (Vec3& p : t->corner) {
        for (int k = 0; k < 3; ++k) p[k] = integer(0, 4) * 0.1;
        p[axis] = height;
      }
    }
  }

  void sliver(Triangle& t) {
    const double thinness = std::ldexp(uniform(-1, 1), -integer(1, 60));
    t[2] = t[0] + weight() * (t[1] - t[0]) + thinness * point();
  }

  void no_area(TrianglePair& pair) {
    Triangle& a = pair.a;
    if (chance(2)) {
      const Vec3 u = lattice_point(2);
      a[0] = lattice_point(2);
      for (int i = 1; i < 3; ++i) a[i] = a[0] + (1.0 * integer(-2, 2)) * u;
      for (Vec3& p : pair.b.corner) p = lattice_point(2);
      if (chance(2)) pair.b[2] = pair.b[1];
    } else {
      a[0] = point_on(pair.b);
      if (chance(2)) a[1] = point_in_plane_of(pair.b);
      a[2] = a[1];
      if (chance(4)) a[2] = a[1] = a[0];
      if (chance(4)) pair.b[2] = pair.b[0];
    }
  }

  void parallel(TrianglePair& pair) {
    const double tilt = chance(3) ? 0 : std::ldexp(1, -integer(1, 60));
    pair.b[0] = point_on(pair.a) + (chance(2) ? std::ldexp(1, -integer(1, 50)) : 0) * point();
    pair.b[1] = pair.b[0] + uniform(-1, 1) * (pair.a[1] - pair.a[0]) + tilt * point();
    if (chance(2)) pair.b[2] = pair.b[0] + uniform(-1, 1) * (pair.a[2] - pair.a[0]) + tilt * point();
  }

  /// Scales and moves a pair into the assembly; half of the pairs by powers of two and integers, which keep
  /// coincidences exact.
  void place(TrianglePair& pair) {
    if (chance(3)) return;
    const bool exact = chance(2);
    const double scale = exact ? std::ldexp(1, integer(-10, 13)) : std::pow(10, uniform(-3, 4));
    const double far = chance(2) ? 0 : std::pow(10, uniform(3, 6));
    const Vec3 somewhere = far * point();
    const Vec3 offset =
        exact ? Vec3{std::floor(somewhere.x), std::floor(somewhere.y), std::floor(somewhere.z)} : somewhere;
    for (Triangle* t : {&pair.a, &pair.b})
      for (Vec3& p : t->corner) p = scale * p + offset;
  }

  /// Moves some coordinates by one or a few units in the last place.
  void nudge(TrianglePair& pair) {
    for (Triangle* t : {&pair.a, &pair.b})
      for (Vec3& p : t->corner)
        for (int k = 0; k < 3; ++k)
          for (int steps = integer(0, 3) - 1; steps > 0; --steps)
            p[k] = std::nextafter(p[k], chance(2) ? INFINITY : -INFINITY);
  }

  void shuffle(Triangle& t) {
    const int first = integer(0, 2);
    t = {{t[first], t[(first + 1) % 3], t[(first + 2) % 3]}};
    if (chance(2)) std::swap(t[0], t[1]);
  }

  std::mt19937_64 random_;
};

}  // namespace dismantle::scenes
