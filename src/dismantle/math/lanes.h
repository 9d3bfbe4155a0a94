// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/lane_operations.h"

/// SIMD lanes: kCount floats that go through the same arithmetic side by side. The result of every lane is
/// bit-identical to that of the scalar operation (round to nearest, no contraction), so a kernel that is a template on
/// the count computes the same numbers at every width.
///
/// A kernel's source is compiled once per width, each time with the flags of that width. The rest of the program is
/// compiled for the baseline machine and chooses the width at run time.
///
/// @code{.unparsed}
///   box_test_kernel.h      the entry, declared for every width, on plain data (pointers, sizes, structs of floats):
///       template <int kLanes>
///       void box_test_kernel(const BoxPairs& pairs, std::uint8_t* overlaps);
///
///   box_test_kernel.cpp    its definition for the width that this compilation is for:
///       #include "dismantle/math/lanes.h"
///       namespace dismantle {
///       inline namespace DISMANTLE_LANES_ISA {
///       template <int kLanes> LaneMask<kLanes> overlap(Lanes<kLanes> a, Lanes<kLanes> b) { return abs(a - b) <= 1; }
///       }
///       template <>
///       void box_test_kernel<DISMANTLE_LANE_COUNT>(const BoxPairs& pairs, std::uint8_t* overlaps) { ... }
///       }
///
///   CMakeLists.txt         after dismantle_component(boxes SOURCES ...):
///       dismantle_lane_kernel(dismantle_boxes box_test_kernel.cpp)
///
///   the caller             (a plain .cpp, with math/lane_dispatch.h)
///       with_lanes(widest_lanes(), [&](auto lanes) { box_test_kernel<lanes>(pairs, overlaps); });
/// @endcode
///
/// An inline function that two compilations emit with different flags is one function to the linker, which keeps either
/// copy; the copy of the AVX2 object ends a machine without AVX2 with SIGILL. Therefore, in a kernel's source,
///   - everything but the entry is in `inline namespace DISMANTLE_LANES_ISA`, whose name depends on the flags (as for
///     Lanes), or has Lanes as a template argument (as Vec3T<Lanes<8>> and its functions);
///   - nothing of std:: is called, no Span is indexed and no contract is checked: pass pointers to the kernel.
/// The test lanes.kernels_share_no_function inspects the objects for violations.
///
/// Keep the loop over the groups of lanes in the function that does the arithmetic. GCC 12 omits vzeroupper in a
/// function of one group that ends by passing Lanes to another, which slows down all scalar code of the program.
namespace dismantle {
inline namespace DISMANTLE_LANES_ISA {

/// One truth value a lane.
template <int kCount, class Operations = LaneOperations<kCount>>
struct LaneMask {
  typename Operations::Mask m;  ///< The register.

  ///@{ Lane by lane.
  DISMANTLE_HOST_DEVICE friend LaneMask operator&(LaneMask a, LaneMask b) { return {Operations::both(a.m, b.m)}; }
  DISMANTLE_HOST_DEVICE friend LaneMask operator|(LaneMask a, LaneMask b) { return {Operations::either(a.m, b.m)}; }
  DISMANTLE_HOST_DEVICE friend LaneMask operator!(LaneMask a) { return {Operations::inverse(a.m)}; }
  ///@}
};

/// The lanes as bits: bit i is set if lane i is true.
template <int kCount, class Operations>
DISMANTLE_HOST_DEVICE unsigned bits(LaneMask<kCount, Operations> a) {
  return Operations::bits(a.m);
}

/// True if a lane is true.
template <int kCount, class Operations>
DISMANTLE_HOST_DEVICE bool any(LaneMask<kCount, Operations> a) {
  return bits(a) != 0;
}

/// True if all lanes are true.
template <int kCount, class Operations>
DISMANTLE_HOST_DEVICE bool all(LaneMask<kCount, Operations> a) {
  return bits(a) == (1u << kCount) - 1;
}

/// kCount floats; 0 by default. Counts: 1 (the scalar) and 4 everywhere, 8 if compiled for AVX2, 16 for AVX-512.
template <int kCount, class Operations = LaneOperations<kCount>>
struct Lanes {
  using Mask = LaneMask<kCount, Operations>;  ///< The type of comparisons.

  typename Operations::Register r = Operations::broadcast(0);  ///< The register.

  Lanes() = default;
  /// The same value in every lane.
  DISMANTLE_HOST_DEVICE Lanes(float x) : r(Operations::broadcast(x)) {}  // NOLINT: a number converts to lanes of it
  /// The lanes of a register.
  DISMANTLE_HOST_DEVICE explicit Lanes(typename Operations::Register x) requires(kCount > 1) : r(x) {}

  /// Reads kCount floats from `from` on, of any alignment.
  DISMANTLE_HOST_DEVICE static Lanes load(const float* from) { return Lanes(Operations::load(from)); }
  /// Writes kCount floats from `to` on, of any alignment.
  DISMANTLE_HOST_DEVICE void store(float* to) const { Operations::store(to, r); }

  ///@{ Lane by lane.
  DISMANTLE_HOST_DEVICE friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.r + b.r); }
  DISMANTLE_HOST_DEVICE friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.r - b.r); }
  DISMANTLE_HOST_DEVICE friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.r * b.r); }
  DISMANTLE_HOST_DEVICE friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.r / b.r); }
  DISMANTLE_HOST_DEVICE friend Lanes operator-(Lanes a) { return Lanes(-a.r); }
  ///@}

  ///@{ Lane by lane; false if one is NaN.
  DISMANTLE_HOST_DEVICE friend Mask operator<(Lanes a, Lanes b) { return {Operations::less(a.r, b.r)}; }
  DISMANTLE_HOST_DEVICE friend Mask operator<=(Lanes a, Lanes b) { return {Operations::less_or_equal(a.r, b.r)}; }
  DISMANTLE_HOST_DEVICE friend Mask operator>(Lanes a, Lanes b) { return {Operations::less(b.r, a.r)}; }
  DISMANTLE_HOST_DEVICE friend Mask operator>=(Lanes a, Lanes b) { return {Operations::less_or_equal(b.r, a.r)}; }
  DISMANTLE_HOST_DEVICE friend Mask operator==(Lanes a, Lanes b) { return {Operations::equal(a.r, b.r)}; }
  ///@}

  /// a < b ? a : b in every lane: b if one is NaN.
  DISMANTLE_HOST_DEVICE friend Lanes min(Lanes a, Lanes b) { return Lanes(Operations::min(a.r, b.r)); }
  /// a > b ? a : b in every lane: b if one is NaN.
  DISMANTLE_HOST_DEVICE friend Lanes max(Lanes a, Lanes b) { return Lanes(Operations::max(a.r, b.r)); }
  ///@{ Lane by lane.
  DISMANTLE_HOST_DEVICE friend Lanes abs(Lanes a) { return Lanes(Operations::abs(a.r)); }
  DISMANTLE_HOST_DEVICE friend Lanes sqrt(Lanes a) { return Lanes(Operations::sqrt(a.r)); }
  ///@}
  /// mask ? a : b in every lane.
  DISMANTLE_HOST_DEVICE friend Lanes select(Mask mask, Lanes a, Lanes b) {
    return Lanes(Operations::select(mask.m, a.r, b.r));
  }
};

}  // namespace DISMANTLE_LANES_ISA
}  // namespace dismantle
