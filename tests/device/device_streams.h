// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit.h"
#include "dismantle/collision/narrow_phase_kernel.h"
#include "dismantle/front/front_kernel.h"
#include "dismantle/math/rigid_transform.h"

#include <cstdint>
#include <string>
#include <vector>

/// The kernel bodies of a step of method `streams`, each run once on a CUDA device over data that is copied there and
/// back: to compare with the CPU. Every function stops the program with a message where CUDA reports an error.
namespace dismantle::device {

/// The name of the device that is used; empty where there is none.
std::string device_name();

/// S_v0, S_tm -> S_v.
std::vector<Vec3> moved_vertices(Span<const Vec3> assembled, const RigidTransform& transform);

/// S_v -> S_bv, S_bvh: all leaves, then the inner nodes level by level.
std::vector<Kdop16> fitted_bounds(const Bvh& bvh, const BvhRefitInput& input);

/// How threads put what they find into a stream (Du et al. 2015, section 4.3).
enum class DeviceLock {
  Global,  ///< An atomic addition on the stream's counter for every value.
  Local,   ///< Into a buffer of the block in shared memory, which goes to the stream with one addition.
};

/// What one launch of a kernel appended, in no particular order, and how often it was run again because something was
/// full.
struct FrontFinds {
  std::vector<std::uint64_t> triangle_pairs, kept, rested, sprouted;
  int replays = 0;
};

/// S_bvh -> S_f, S_t: looks at the kernel's items, and in further rounds at what they leave over.
/// @param kernel views of host memory
/// @param capacity that the streams start with
FrontFinds sprouted_front(const FrontSproutKernel& kernel, DeviceLock lock, std::size_t capacity);

struct NarrowFinds {
  std::vector<TrianglePairContact> contacts;
  std::vector<std::uint64_t> intersections;
  std::size_t tests = 0;
  int replays = 0;
};

/// S_t -> contacts and intersections. @param kernel views of host memory
NarrowFinds tested_pairs(const NarrowPhaseKernel& kernel, std::size_t capacity);

}  // namespace dismantle::device
