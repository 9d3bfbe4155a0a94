// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_lanes_certificates.h"

#include <algorithm>

/// The search for certificates: for lane kernels only (math/lanes.h). What is tried is guesswork, what is accepted is
/// proved.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// How often an axis is improved, in the first and in the second look at what the guess leaves.
inline constexpr int kFewImprovements = 2;
inline constexpr int kManyImprovements = 6;

/// An improvement turns the axis beyond the plane across the difference that spoils it by this part of the way there.
inline constexpr float kOvershoot = 1.5f;

/// Turns an axis so that it separates the difference that spoiled it most (the perceptron's rule).
template <int N>
LaneVec<N> improved(LaneVec<N> axis, const LaneGap<N>& seen) {
  const Lanes<N> wanting = 2.0f * seen.error - seen.gap;
  return axis + seen.difference * (kOvershoot * wanting / dot(seen.difference, seen.difference));
}

/// Proves what it can of N motions, by the sign of their volume and by an axis improved up to `improvements` times.
template <int N, class Feature>
LaneMask<N> search(const RelativePoints<N>& points, int improvements) {
  const LaneVec<N> reach = reach_of(points);
  LaneVec<N> axis = Feature::guess(points);
  LaneMask<N> free = never_coplanar(points, reach);
  for (int i = 0;; ++i) {
    const LaneGap<N> seen = Feature::gap(points, axis, reach);
    free = free | seen.separates();
    if (i == improvements || all(free)) return free;
    axis = improved(axis, seen);
  }
}

/// Looks again at the motions of a list, and shortens it to those that are still undecided; gives its new size.
template <int N, class Feature>
std::uint32_t search_list(const double* motions, std::uint32_t* list, std::uint32_t size, int improvements) {
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < size; i += N) {
    std::uint32_t numbers[N];
    for (std::uint32_t lane = 0; lane < N; ++lane) numbers[lane] = list[i + lane < size ? i + lane : size - 1];
    const auto points = Feature::Rows::template gather<N>(ListedMotions{motions, numbers});
    const std::uint32_t used = size - i < N ? size - i : N;
    unsigned undecided = ~bits(search<N, Feature>(points, improvements)) & ((1u << used) - 1);
    for (; undecided != 0; undecided &= undecided - 1) list[left++] = numbers[__builtin_ctz(undecided)];
  }
  return left;
}

/// Asks for the memory of N motions, in the second-level cache: while what the guess leaves is searched nothing is read
/// from memory, and what the processor fetches by itself does not go so far.
template <int N>
void fetch(const double* motions) {
  constexpr int kDoublesOfLine = 8, kSecondLevel = 2;
  for (int k = 0; k < N * kMotionDoubles; k += kDoublesOfLine) __builtin_prefetch(motions + k, 0, kSecondLevel);
}

/// Tries the guessed axis on up to 64 motions; bit i of the result is set where motion i is not proved free, also where
/// it is left over from full lanes.
/// @param fetched fetches so many motions from `next` on, some after each of these: all at once would hold it up
template <int N, class Feature>
std::uint64_t left_by_guess(const double* motions, std::uint32_t count, const double* next, std::uint32_t fetched) {
  std::uint64_t free = 0;
  for (std::uint32_t i = 0; i + N <= count; i += N) {
    if (i < fetched) fetch<N>(next + std::size_t{i} * kMotionDoubles);
    const auto points =
        Feature::Rows::template gather<N>(ConsecutiveMotions{motions + std::size_t{i} * kMotionDoubles});
    const LaneGap<N> seen = Feature::gap(points, Feature::guess(points), reach_of(points));
    free |= std::uint64_t{bits(seen.separates())} << i;
  }
  return ~free & (~std::uint64_t{0} >> (64 - count));
}

/// The kernel of ccd_lanes_kernel.h for a pair of features.
template <int N, class Feature>
std::uint32_t undecided_motions(const double* motions, std::uint32_t count, std::uint32_t next, std::uint32_t* list) {
  std::uint32_t size = 0;
  for (std::uint32_t i = 0; i < count; i += 64) {
    const std::uint32_t part = count - i < 64 ? count - i : 64;
    const double* first = motions + std::size_t{i} * kMotionDoubles;
    const std::uint32_t fetched = next > i ? std::min(part, next - i) : 0;
    std::uint64_t undecided =
        left_by_guess<N, Feature>(first, part, first + std::size_t{count} * kMotionDoubles, fetched);
    for (; undecided != 0; undecided &= undecided - 1) list[size++] = i + __builtin_ctzll(undecided);
  }
  size = search_list<N, Feature>(motions, list, size, kFewImprovements);
  return search_list<N, Feature>(motions, list, size, kManyImprovements);
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
