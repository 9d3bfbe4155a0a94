// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_lanes_certificates.h"

#include <algorithm>

/// The search for certificates, for lane kernels only (math/lanes.h). Axes are chosen by a heuristic; those accepted
/// are proved.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

///@{ Number of times that an axis is improved, in the first and in the second pass over the motions that the guess
/// leaves.
inline constexpr int kFewImprovements = 2;
inline constexpr int kManyImprovements = 6;
///@}

/// Overrelaxation of an improvement: the axis turns by this multiple of what makes the smallest gap twice the error
/// bound.
inline constexpr float kOvershoot = 1.5f;

/// Turns an axis towards the difference with the smallest gap (the perceptron's rule).
template <int N>
LaneVec<N> improved(LaneVec<N> axis, const LaneGap<N>& found) {
  const Lanes<N> missing = 2.0f * found.error - found.gap;
  return axis + found.difference * (kOvershoot * missing / dot(found.difference, found.difference));
}

/// The lanes that are proved free, by the sign of the volume and by an axis that is improved up to `improvements`
/// times.
template <int N, class Feature>
LaneMask<N> search(const RelativePoints<N>& points, int improvements) {
  const LaneVec<N> reach = reach_of(points);
  LaneVec<N> axis = Feature::guess(points);
  LaneMask<N> free = never_coplanar(points, reach);
  for (int i = 0;; ++i) {
    const LaneGap<N> found = Feature::gap(points, axis, reach);
    free = free | found.separates();
    if (i == improvements || all(free)) return free;
    axis = improved(axis, found);
  }
}

/// Searches the motions of a list again and shortens it to those that remain undecided.
/// @param list indices of motions; @return its new size
template <int N, class Feature>
std::uint32_t search_list(const double* motions, std::uint32_t* list, std::uint32_t size, int improvements) {
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < size; i += N) {
    std::uint32_t indices[N];
    for (std::uint32_t lane = 0; lane < N; ++lane) indices[lane] = list[i + lane < size ? i + lane : size - 1];
    const auto points = Feature::Rows::template gather<N>(ListedMotions{motions, indices});
    const std::uint32_t used = size - i < N ? size - i : N;
    unsigned undecided = ~bits(search<N, Feature>(points, improvements)) & ((1u << used) - 1);
    for (; undecided != 0; undecided &= undecided - 1) list[left++] = indices[__builtin_ctz(undecided)];
  }
  return left;
}

/// Prefetches N motions into the second-level cache: while the motions that the guess leaves are searched nothing is
/// read from memory, and the processor's own prefetching does not reach so far.
template <int N>
void fetch(const double* motions) {
  constexpr int kDoublesOfLine = 8, kSecondLevel = 2;
  for (int k = 0; k < N * kMotionDoubles; k += kDoublesOfLine) __builtin_prefetch(motions + k, 0, kSecondLevel);
}

/// Tries the guessed axis on up to 64 motions; bit i of the result is set where motion i is not proved free, also where
/// it does not fill the lanes.
/// @param fetched number of motions to prefetch from `next` on, some after each of these: all at once would stall
template <int N, class Feature>
std::uint64_t undecided_by_guess(const double* motions, std::uint32_t count, const double* next,
                                 std::uint32_t fetched) {
  std::uint64_t free = 0;
  for (std::uint32_t i = 0; i + N <= count; i += N) {
    if (i < fetched) fetch<N>(next + std::size_t{i} * kMotionDoubles);
    const auto points =
        Feature::Rows::template gather<N>(ConsecutiveMotions{motions + std::size_t{i} * kMotionDoubles});
    const LaneGap<N> found = Feature::gap(points, Feature::guess(points), reach_of(points));
    free |= std::uint64_t{bits(found.separates())} << i;
  }
  return ~free & (~std::uint64_t{0} >> (64 - count));
}

/// The kernel of ccd_lanes_kernel.h for a pair of features.
/// @tparam Feature its rows (`Rows`), a guessed axis (`guess`) and the gap along an axis (`gap`)
template <int N, class Feature>
std::uint32_t undecided_motions(const double* motions, std::uint32_t count, std::uint32_t next, std::uint32_t* list) {
  std::uint32_t size = 0;
  for (std::uint32_t i = 0; i < count; i += 64) {
    const std::uint32_t part = count - i < 64 ? count - i : 64;
    const double* first = motions + std::size_t{i} * kMotionDoubles;
    const std::uint32_t fetched = next > i ? std::min(part, next - i) : 0;
    std::uint64_t undecided =
        undecided_by_guess<N, Feature>(first, part, first + std::size_t{count} * kMotionDoubles, fetched);
    for (; undecided != 0; undecided &= undecided - 1) list[size++] = i + __builtin_ctzll(undecided);
  }
  size = search_list<N, Feature>(motions, list, size, kFewImprovements);
  return search_list<N, Feature>(motions, list, size, kManyImprovements);
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
