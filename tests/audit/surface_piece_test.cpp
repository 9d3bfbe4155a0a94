// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/surface_piece.h"

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/solid/piece_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dismantle {
namespace {

using audit::RelativeMotion;
using audit::SurfacePiece;
using audit::TimeSlice;

constexpr std::uint64_t kSeed = 91;

class SurfacePieces : public testing::Test {
 protected:
  Vec3 vector(double size) { return size * Vec3{normal_(random_), normal_(random_), normal_(random_)}; }
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// A triangle on a random screw, and a part of the segment.
  void next() {
    motion_.start = {mat3_from_quat(quat_about(normalized(vector(1)), number(0, 3))), vector(1)};
    motion_.screw.axis = normalized(vector(1));
    motion_.screw.angle = std::pow(10, number(-2, 0.4));
    motion_.screw.velocity = vector(std::pow(10, number(-2, 0)));
    const double at = number(0, 0.5);
    slice_ = {0, at, at + number(0.1, 0.5), motion_.at(at), {}, &motion_};
    slice_.end = motion_.at(slice_.to);
    const double size = std::pow(10, number(-2, 0));
    const Vec3 middle = vector(1);
    for (int k = 0; k < 3; ++k) body_[k] = middle + vector(size);
    piece_ = make_piece(slice_, body_);
  }

  /// A random point of the triangle at a random time of the slice, and the same on its chord.
  std::pair<Vec3, Vec3> sample() {
    const double u = number(0, 1), v = number(0, 1 - u), part = number(0, 1);
    const auto mix = [&](Vec3 a, Vec3 b, Vec3 c) { return (1 - u - v) * a + u * b + v * c; };
    const Vec3* c = piece_.corner;
    const Vec3 chord = (1 - part) * mix(c[0], c[1], c[2]) + part * mix(c[3], c[4], c[5]);
    const Vec3 arc = motion_.at(slice_.from + part * (slice_.to - slice_.from)) * mix(body_[0], body_[1], body_[2]);
    return {arc, chord};
  }

  std::mt19937_64 random_{kSeed};
  std::normal_distribution<double> normal_;
  RelativeMotion motion_;
  TimeSlice slice_;
  Triangle body_;
  SurfacePiece piece_;
};

TEST_F(SurfacePieces, BoundTheDeviationOfArcsClosely) {
  double closest = 0;
  for (int i = 0; i < 2000; ++i) {
    next();
    for (int k = 0; k < 20; ++k) {
      const auto [arc, chord] = sample();
      EXPECT_LE(length(arc - chord), piece_.deviation + 1e-12) << "seed " << kSeed;
      EXPECT_LE(length(arc - piece_.center), piece_.radius + 1e-12);
      closest = std::max(closest, length(arc - chord) / piece_.deviation);
    }
  }
  EXPECT_GT(closest, 0.9);
}

TEST_F(SurfacePieces, StayWithinWhatIsSaidOfThem) {
  int within = 0;
  for (int i = 0; i < 4000; ++i) {
    next();
    Triangle t;
    for (int k = 0; k < 3; ++k) t[k] = piece_.center + vector(1);
    const double limit = std::pow(10, number(-1, 0.3));
    if (!stays_within(piece_, t, limit)) continue;
    ++within;
    for (int k = 0; k < 40; ++k) EXPECT_LE(audit::distance_to_triangle(t, sample().first), limit + 1e-12);
  }
  EXPECT_GT(within, 200);
}

TEST_F(SurfacePieces, StayWithinEitherOfTwoTriangles) {
  int together = 0;
  for (int i = 0; i < 40000; ++i) {
    next();
    // Two faces on either side of the piece, or at an angle.
    Triangle s, t;
    const Vec3 off = number(0, 0.6) * normalized(vector(1));
    for (int k = 0; k < 3; ++k) {
      s[k] = piece_.center + off + vector(1.5);
      t[k] = piece_.center - off + vector(1.5);
    }
    const double limit = std::pow(10, number(-1, 0.2));
    if (!stays_within_either(piece_, s, t, limit)) continue;
    together += !stays_within(piece_, s, limit) && !stays_within(piece_, t, limit);
    for (int k = 0; k < 40; ++k) {
      const Vec3 p = sample().first;
      EXPECT_LE(std::min(audit::distance_to_triangle(s, p), audit::distance_to_triangle(t, p)), limit + 1e-12);
    }
  }
  EXPECT_GT(together, 100);
}

/// Triangles as near as the test allows: they are moved towards the piece until it is no longer certain to pass.
TEST_F(SurfacePieces, PassClearOfTrianglesThatTheyDoNotMeet) {
  int near = 0;
  for (int i = 0; i < 1500; ++i) {
    next();
    const double margin = i % 3 == 0 ? 1e-9 : std::pow(10, number(-3, -0.5));
    const Vec3 from = piece_.center + 3.0 * normalized(vector(1)), shift = vector(0.1);
    Triangle far;
    for (int k = 0; k < 3; ++k) far[k] = from + vector(0.5);
    double clear = 0, meets = 1;
    Triangle t = far;
    for (int k = 0; k < 20; ++k) {
      const double part = (clear + meets) / 2;
      for (int c = 0; c < 3; ++c) t[c] = far[c] + part * (piece_.center - from);
      (passes_clear(piece_, shift, t, margin) ? clear : meets) = part;
    }
    for (int c = 0; c < 3; ++c) t[c] = far[c] + clear * (piece_.center - from);
    if (!passes_clear(piece_, shift, t, margin)) continue;
    ++near;
    // Beyond some plane by the margin, so that no sample is nearer to the triangle.
    for (int k = 0; k < 60; ++k) EXPECT_GT(audit::distance_to_triangle(t, sample().first + shift), 0.999 * margin);
  }
  EXPECT_GT(near, 1000);
}

/// A blade that turns past a plane: on chords it stays clear of it, on its arc it does not.
TEST_F(SurfacePieces, DoNotPassClearWhereOnlyTheirChordsDo) {
  motion_.start = RigidTransform{};
  motion_.screw.axis = {0, 0, 1};
  motion_.screw.angle = 1;
  const auto mat = mat3_from_quat(quat_about({0, 0, 1}, -0.5));
  body_ = {{mat * Vec3{0, -1, 0}, mat * Vec3{0, -0.9, 0}, mat * Vec3{0, -1, 0.1}}};
  slice_ = {0, 0, 1, motion_.at(0), motion_.at(1), &motion_};
  piece_ = make_piece(slice_, body_);
  const double chord = -std::cos(0.5);
  for (const double share : {0.1, 0.45, 0.6, 0.9}) {
    const double y = chord - share * (1 - std::cos(0.5));  // the blade reaches down to -1
    const Triangle plane{{{-9, y, -9}, {9, y, -9}, {0, y, 20}}};
    EXPECT_FALSE(passes_clear(piece_, {}, plane, 0)) << share;
    EXPECT_FALSE(stays_within(piece_, {{{-9, y + 0.5, -9}, {9, y + 0.5, -9}, {0, y + 0.5, 20}}}, 0.5 - 0.01)) << share;
  }
  const Triangle below{{{-9, -1.01, -9}, {9, -1.01, -9}, {0, -1.01, 20}}};
  EXPECT_TRUE(passes_clear(piece_, {}, below, 0));
}

TEST(ClosestPoint, IsOnTheTriangleAndAsNearAsThat) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) { return size * Vec3{normal(random), normal(random), normal(random)}; };
  for (int i = 0; i < 20000; ++i) {
    Triangle t{{vector(1), vector(1), vector(1)}};
    if (i % 5 == 1) t[2] = t[0] + 0.3 * (t[1] - t[0]) + vector(1e-5);         // a needle
    if (i % 5 == 2) t = {{{0, 0, 0}, {2, 0, 0}, {i % 2 ? 1.0 : 3.0, 0, 0}}};  // on a line
    if (i % 5 == 3) t[1] = t[2] = t[0];
    const Vec3 point = vector(i % 3 ? 3 : 0.3);
    const Vec3 closest = audit::closest_point(t, point);
    EXPECT_LE(audit::distance_to_triangle(t, closest), 1e-7) << i;
    EXPECT_NEAR(length(closest - point), audit::distance_to_triangle(t, point), 1e-7) << i;
  }
}

}  // namespace
}  // namespace dismantle
