// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace dismantle {

/// Number of doubles of a VertexFaceMotion or an EdgeEdgeMotion.
inline constexpr int kMotionDoubles = 24;

/// Largest number of lanes of a kernel.
inline constexpr int kMaxLanes = 16;

/// Tests motions of a vertex and a face in kLanes lanes of float and writes the indices (ascending) of those that it
/// cannot prove free to `undecided`. All others are certainly free. The result is the same for every number of lanes.
/// @param motions VertexFaceMotion as doubles, shape [count][kMotionDoubles]
/// @param next number of motions that follow these in memory and come next: they are prefetched into the second-level
///   cache
/// @param undecided room for count + kMaxLanes indices
/// @return the number of undecided motions
template <int kLanes>
std::uint32_t vertex_face_lanes_kernel(const double* motions, std::uint32_t count, std::uint32_t next,
                                       std::uint32_t* undecided);

/// As vertex_face_lanes_kernel(), for motions of two edges (EdgeEdgeMotion as doubles).
template <int kLanes>
std::uint32_t edge_edge_lanes_kernel(const double* motions, std::uint32_t count, std::uint32_t next,
                                     std::uint32_t* undecided);

}  // namespace dismantle
