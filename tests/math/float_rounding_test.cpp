// SPDX-License-Identifier: Apache-2.0
// Compiled as the library is, not as tests are (CMakeLists.txt): the fault of a compiler that is looked for depends on
// it.
#include "dismantle/math/vec3f.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

struct FloatAxes {
  Vec3f axis[2];
};

#ifdef __GNUC__
[[gnu::noinline]]
#endif
Vec3 cross_of_rounded(const Vec3& a, const Vec3& b) {
  FloatAxes axes;
  axes.axis[0] = to_float(a);
  axes.axis[1] = to_float(b);
  const Vec3 x = to_double(axes.axis[0]), y = to_double(axes.axis[1]);
  return cross(x, y);
}

double rounded(double x) {
  const volatile float kept = static_cast<float>(x);
  return static_cast<double>(kept);
}

// GCC 12 at -O2, unless it leaves straight code alone: the cross product of the doubles.
TEST(FloatRounding, OfDoublesIsKeptWhereTheyAreUsedAtOnce) {
  volatile double values[] = {0.1, 0.7, 1 / 3.0, 0.3, -0.2, 1 / 7.0};  // unknown to the compiler
  const Vec3 a{values[0], values[1], values[2]}, b{values[3], values[4], values[5]};
  const Vec3 found = cross_of_rounded(a, b);
  EXPECT_EQ(found.x, rounded(a.y) * rounded(b.z) - rounded(a.z) * rounded(b.y));
  EXPECT_EQ(found.y, rounded(a.z) * rounded(b.x) - rounded(a.x) * rounded(b.z));
  EXPECT_EQ(found.z, rounded(a.x) * rounded(b.y) - rounded(a.y) * rounded(b.x));
}

}  // namespace
}  // namespace dismantle
