// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/ccd_lanes_certificates.h"

/// The search for certificates: for lane kernels only (math/lanes.h). What is tried is guesswork, what is accepted is
/// proved.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// How often an axis is improved, in the first and in the second look at what the guess leaves.
inline constexpr int kFewImprovements = 2;
inline constexpr int kManyImprovements = 12;

/// An improvement turns the axis beyond the plane across the difference that spoils it by this part of the way there.
inline constexpr float kOvershoot = 1.5f;

/// Appends the numbers of the lanes that are not free, without a branch, to a list of `size`; gives its new size.
template <int N>
std::uint32_t keep_undecided(LaneMask<N> free, const std::uint32_t* numbers, std::uint32_t used, std::uint32_t* list,
                             std::uint32_t size) {
  const unsigned kept = ~bits(free) & ((1u << used) - 1);
  for (int lane = 0; lane < N; ++lane) {
    list[size] = numbers[lane];
    size += kept >> lane & 1u;
  }
  return size;
}

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
    const LaneMask<N> free = search<N, Feature>(points, improvements);
    left = keep_undecided<N>(free, numbers, size - i < N ? size - i : N, list, left);
  }
  return left;
}

/// The kernel of ccd_lanes_kernel.h for a pair of features.
template <int N, class Feature>
std::uint32_t undecided_motions(const double* motions, std::uint32_t count, std::uint32_t* list) {
  std::uint32_t size = 0, i = 0;
  for (; i + N <= count; i += N) {
    const auto points =
        Feature::Rows::template gather<N>(ConsecutiveMotions{motions + std::size_t{i} * kMotionDoubles});
    const LaneGap<N> seen = Feature::gap(points, Feature::guess(points), reach_of(points));
    std::uint32_t numbers[N];
    for (std::uint32_t lane = 0; lane < N; ++lane) numbers[lane] = i + lane;
    size = keep_undecided<N>(seen.separates(), numbers, N, list, size);
  }
  for (; i < count; ++i) list[size++] = i;
  size = search_list<N, Feature>(motions, list, size, kFewImprovements);
  return search_list<N, Feature>(motions, list, size, kManyImprovements);
}

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
