// SPDX-License-Identifier: Apache-2.0
// Time of the discrete tests of triangle pairs, one thread.
//   bench_triangle_pairs
// One row a set of pairs and a test, tab-separated: the share of the pairs that intersect, and the mean time of a test
// in the fastest of kPasses passes over the set.
//   near          random triangles whose boxes overlap: what a bounding volume hierarchy does not cull
//   face_contact  triangles of the faces of two boxes that lie on each other, turned out of the axes: the signs of such
//                 pairs are all in doubt, and rounding decides them
//   axis_contact  the same, along the axes: exactly coplanar
#include "bench/timing.h"
#include "dismantle/geometry/aabb.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "tests/support/triangle_pairs.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

using namespace dismantle;
using namespace dismantle::scenes;

constexpr int kPasses = 200;
constexpr std::size_t kPairs = 2000;
constexpr std::uint64_t kSeed = 1;

Aabb box(const Triangle& t) {
  return {min(t[0], min(t[1], t[2])), max(t[0], max(t[1], t[2]))};
}

std::vector<TrianglePair> near_pairs() {
  TrianglePairs random(kSeed);
  std::vector<TrianglePair> pairs;
  while (pairs.size() < kPairs) {
    const TrianglePair pair = random.next(PairKind::Random);
    if (overlaps(box(pair.a), box(pair.b))) pairs.push_back(pair);
  }
  return pairs;
}

/// Pairs of one plane z = 0.1 whose boxes overlap, with the third coordinate turned into the other two by `turn`.
std::vector<TrianglePair> contact_pairs(double turn) {
  TrianglePairs random(kSeed);
  std::vector<TrianglePair> pairs;
  while (pairs.size() < kPairs) {
    TrianglePair pair = random.next(PairKind::Random);
    for (Triangle* t : {&pair.a, &pair.b}) {
      for (Vec3& p : t->corner) {
        p.z = 0.1;
        p = {p.x - turn * p.z, p.y - turn * turn * p.z, p.z + turn * p.x + turn * turn * p.y};
      }
    }
    if (overlaps(box(pair.a), box(pair.b))) pairs.push_back(pair);
  }
  return pairs;
}

template <class Test>
void measure(const char* set, const char* name, const std::vector<TrianglePair>& pairs, const Test& test) {
  double sum = 0;
  const double fastest = bench::fastest_ns(kPasses, [&] {
    sum = 0;
    for (const TrianglePair& pair : pairs) sum += test(pair.a, pair.b);
    bench::keep(sum);
  });
  const auto intersecting = std::count_if(
      pairs.begin(), pairs.end(), [](const TrianglePair& pair) { return intersect_triangle_triangle(pair.a, pair.b); });
  std::printf("%s\t%s\t%.3f\t%.1f\t%.9g\n", set, name, static_cast<double>(intersecting) / pairs.size(),
              fastest / pairs.size(), sum);
}

void measure_all(const char* set, const std::vector<TrianglePair>& pairs) {
  measure(set, "intersect", pairs,
          [](const Triangle& a, const Triangle& b) { return intersect_triangle_triangle(a, b); });
  measure(set, "penetration", pairs,
          [](const Triangle& a, const Triangle& b) { return penetration_triangle_triangle(a, b).depth; });
  measure(set, "distance", pairs,
          [](const Triangle& a, const Triangle& b) { return distance_triangle_triangle(a, b).distance; });
}

}  // namespace

int main() {
  std::printf("set\ttest\tintersecting_share\tmean_ns\tsum\n");
  measure_all("near", near_pairs());
  measure_all("face_contact", contact_pairs(0.3));
  measure_all("axis_contact", contact_pairs(0));
  return 0;
}
