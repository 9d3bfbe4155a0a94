// SPDX-License-Identifier: Apache-2.0
// Exactness of the discrete triangle pair tests: random and nearly or exactly degenerate pairs against exact integer
// arithmetic.
//   soak_triangle_pairs [COUNT [SEED]]
// COUNT pairs (default 100000), the same number of each family. One row a family and one "total", tab-separated; before
// them, in lines that begin with "#", the first wrong pairs in hexadecimal. Exit code 1 where anything is wrong.
#include "bench/command_line.h"
#include "tests/support/check_triangle_pair.h"

#include <cstdio>

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
  bench::CommandLine line("soak_triangle_pairs [COUNT [SEED]]");
  std::vector<std::uint64_t> numbers = {100'000};
  line.numbers(numbers);
  if (!line.parse(argc, argv) || (numbers.size() > 2 && !line.wrong())) return bench::kExitUsage;
  const std::uint64_t count = numbers[0], seed = numbers.size() > 1 ? numbers[1] : 1;
  constexpr int kKinds = static_cast<int>(PairKind::kCount);
  TrianglePairs pairs(seed);
  PairCheck per_kind[kKinds], total;
  int shown = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const int kind = static_cast<int>(i % kKinds);
    const TrianglePair pair = pairs.next(static_cast<PairKind>(kind));
    const PairCheck check = check_pair(pair);
    per_kind[kind].add(check);
    if (!check.passed() && shown++ < kShownPairs) show(name_of(static_cast<PairKind>(kind)), pair);
  }

  std::printf("# seed %llu\n", static_cast<unsigned long long>(seed));
  std::printf(
      "family\tpairs\tintersecting\tsigns\twrong_signs\twrong_intersections\twrong_depths\twrong_distances\t"
      "max_relative_depth_error\tmax_relative_distance_error\n");
  for (int kind = 0; kind < kKinds; ++kind) {
    print(name_of(static_cast<PairKind>(kind)), per_kind[kind]);
    total.add(per_kind[kind]);
  }
  print("total", total);
  return total.passed() ? 0 : bench::kExitFailed;
}
