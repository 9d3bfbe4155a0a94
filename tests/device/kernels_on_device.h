// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/bvh/bvh_refit.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/streams/narrow_phase_kernel.h"

#include <cstdint>
#include <vector>

/// The kernel bodies of a step of method `streams`, each run once on a CUDA device over data copied there and back, for
/// comparison with the CPU. Throws CudaError. @pre there is a device
namespace dismantle::device {

/// S_v0, S_tm -> S_v.
std::vector<Vec3> moved_vertices(Span<const Vec3> assembled, const RigidTransform& transform);

/// S_v -> S_bv, S_bvh: all leaves, then the inner nodes level by level.
std::vector<Kdop16> fitted_bounds(const Bvh& bvh, const BvhRefitInput& input);

struct NarrowFinds {
  std::vector<TrianglePairContact> contacts;
  std::vector<std::uint64_t> intersections;
  std::size_t tests = 0;
  int replays = 0;
};

/// S_t -> contacts and intersections. @param kernel views of host memory
NarrowFinds tested_pairs(const NarrowPhaseKernel& kernel, std::size_t capacity);

}  // namespace dismantle::device
