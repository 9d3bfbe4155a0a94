// SPDX-License-Identifier: Apache-2.0
// soak_triangle_pairs [COUNT [SEED]]: holds the discrete triangle pair tests against exact integer arithmetic on COUNT
// random and nearly or exactly degenerate pairs (default 100000, seed 1), the same number of each family. Prints a line
// a family and a total (tab-separated, header first) and the first wrong pairs in hexadecimal; exit 1 where anything is
// wrong.
#include "tests/support/check_triangle_pair.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace dismantle;
using namespace dismantle::scenes;

constexpr int kShownPairs = 5;

void print(const char* family, const PairCheck& c) {
  std::printf("%s", family);
  for (const std::int64_t count :
       {c.pairs, c.meeting, c.signs, c.wrong_signs, c.wrong_intersections, c.wrong_depths, c.wrong_distances})
    std::printf("\t%lld", static_cast<long long>(count));
  std::printf("\t%.2g\t%.2g\n", c.worst_depth_error, c.worst_distance_error);
}

void show(const char* family, const TrianglePair& pair) {
  std::printf("# wrong (%s):", family);
  for (const Triangle* t : {&pair.a, &pair.b})
    for (const Vec3& p : t->corner) std::printf(" {%a, %a, %a}", p.x, p.y, p.z);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const long long count = argc > 1 ? std::atoll(argv[1]) : 100000;
  const unsigned long long seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  if (count <= 0 || argc > 3) {
    std::fprintf(stderr, "usage: soak_triangle_pairs [COUNT [SEED]]\n");
    return 2;
  }
  constexpr int kKinds = static_cast<int>(PairKind::kCount);
  TrianglePairs pairs(seed);
  PairCheck per_kind[kKinds], total;
  int shown = 0;
  for (long long i = 0; i < count; ++i) {
    const int kind = static_cast<int>(i % kKinds);
    const TrianglePair pair = pairs.next(static_cast<PairKind>(kind));
    const PairCheck check = check_pair(pair);
    per_kind[kind].add(check);
    if (!check.passed() && shown++ < kShownPairs) show(name_of(static_cast<PairKind>(kind)), pair);
  }

  std::printf("# seed %llu\n", seed);
  std::printf(
      "family\tpairs\tmeeting\tsigns\twrong_signs\twrong_intersections\twrong_depths\twrong_distances\t"
      "worst_depth_error\tworst_distance_error\n");
  for (int kind = 0; kind < kKinds; ++kind) {
    print(name_of(static_cast<PairKind>(kind)), per_kind[kind]);
    total.add(per_kind[kind]);
  }
  print("total", total);
  return total.passed() ? 0 : 1;
}
