// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_result.h"

#include <cmath>
#include <random>

/// Motions whose features meet exactly at a known time: all coordinates, the contact point and the time lie on a dyadic
/// grid with so few bits that no operation rounds.
namespace dismantle::exact {

/// A motion with a contact in exact arithmetic at `time` (there may be an earlier one).
template <class Motion>
struct Hit {
  Motion motion;
  double time = 0;
};

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  /// A vertex that meets a point of a face (weights: multiples of 1/4) at a multiple of 1/8. Some faces are slivers;
  /// some motions are scaled by a power of two and translated to coordinates of about 1000.
  Hit<VertexFaceMotion> vertex_face() {
    start_scene();
    VertexFaceMotion m;
    for (int i = 0; i < 3; ++i) {
      m.face_t0[i] = vector();
      m.face_t1[i] = m.face_t0[i] + path();
    }
    if (integer(0, 3) == 0) make_sliver(m.face_t0);
    if (integer(0, 3) == 0) m.face_t1 = {{m.face_t0[0] + path(), m.face_t0[1], m.face_t0[2]}};
    const double time = integer(0, 8) / 8.0;
    const int first = integer(0, 4), second = integer(0, 4 - first);
    const double w0 = first / 4.0, w1 = second / 4.0, w2 = 1 - w0 - w1;
    const auto now = [&](int i) { return (1 - time) * m.face_t0[i] + time * m.face_t1[i]; };
    through(w0 * now(0) + w1 * now(1) + w2 * now(2), time, m.vertex_t0, m.vertex_t1);
    for (Vec3* p : {&m.vertex_t0, &m.vertex_t1, &m.face_t0[0], &m.face_t0[1], &m.face_t0[2], &m.face_t1[0],
                    &m.face_t1[1], &m.face_t1[2]})
      place(*p);
    return {m, time};
  }

  /// Two edges that meet at a quarter, half or end point of each, at a multiple of 1/8. Some edges are nearly parallel.
  Hit<EdgeEdgeMotion> edge_edge() {
    start_scene();
    EdgeEdgeMotion m;
    for (int i = 0; i < 2; ++i) {
      m.a_t0[i] = vector();
      m.a_t1[i] = m.a_t0[i] + path();
    }
    m.b_t0[0] = integer(0, 2) == 0 ? m.a_t0[0] + path() : vector();
    m.b_t1[0] = m.b_t0[0] + path();
    const double time = integer(0, 8) / 8.0;
    const double along_a = integer(0, 4) / 4.0;
    const double inverse_along_b = std::ldexp(1.0, integer(0, 2));
    const Vec3 a0 = (1 - time) * m.a_t0[0] + time * m.a_t1[0], a1 = (1 - time) * m.a_t0[1] + time * m.a_t1[1];
    const Vec3 b0 = (1 - time) * m.b_t0[0] + time * m.b_t1[0];
    const Vec3 meeting = (1 - along_a) * a0 + along_a * a1;
    through(b0 + inverse_along_b * (meeting - b0), time, m.b_t0[1], m.b_t1[1]);
    for (int i = 0; i < 2; ++i)
      for (Vec3* p : {&m.a_t0[i], &m.a_t1[i], &m.b_t0[i], &m.b_t1[i]}) place(*p);
    return {m, time};
  }

 private:
  /// Coordinates are multiples of 1/32 below 2^14, of which a log-uniform part is used; then 20 bits suffice for all.
  void start_scene() {
    size_ = 1 << integer(0, 10);
    way_ = 1 << integer(0, 10);
    scale_ = std::ldexp(1.0, integer(-24, 3));
    offset_ = integer(0, 1) == 0 ? Vec3{} : Vec3{1024.0 * integer(-9, 9), 1024.0 * integer(-9, 9), 0};
    offset_ = scale_ * offset_;
  }
  Vec3 grid(int reach) {
    return {double(integer(-reach, reach)), double(integer(-reach, reach)), double(integer(-reach, reach))};
  }
  Vec3 vector() { return grid(size_); }
  Vec3 path() { return integer(0, 4) == 0 ? Vec3{} : grid(way_); }
  void make_sliver(Triangle& t) { t[2] = t[0] + 2.0 * (t[1] - t[0]) + grid(1); }
  /// The ends of a linear path that is at `point` at `time`.
  void through(Vec3 point, double time, Vec3& t0, Vec3& t1) {
    const Vec3 d = path();
    t0 = point - time * d;
    t1 = point + (1 - time) * d;
  }
  void place(Vec3& p) { p = scale_ * p + offset_; }

  std::mt19937_64 random_;
  int size_ = 1, way_ = 1;
  double scale_ = 1;
  Vec3 offset_;
};

}  // namespace dismantle::exact
