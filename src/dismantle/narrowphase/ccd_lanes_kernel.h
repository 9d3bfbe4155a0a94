// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace dismantle {

/// The numbers of one motion in memory: of a VertexFaceMotion or an EdgeEdgeMotion.
inline constexpr int kMotionDoubles = 24;

/// The most lanes that a kernel works in.
inline constexpr int kMaxLanes = 16;

/// Looks at `count` motions one after another in memory (VertexFaceMotion as its doubles, shape
/// [count][kMotionDoubles]) in kLanes lanes of float, and writes the numbers (0 to count - 1, ascending) of those that
/// it cannot prove free to `undecided`, which has room for count + kMaxLanes of them. All others are certainly free.
/// Gives how many are undecided. They are the same at every width.
/// @param next how many motions behind these come next: meanwhile they are brought into the second-level cache
template <int kLanes>
std::uint32_t vertex_face_lanes_kernel(const double* motions, std::uint32_t count, std::uint32_t next,
                                       std::uint32_t* undecided);

/// The same for motions of two edges (EdgeEdgeMotion as its doubles).
template <int kLanes>
std::uint32_t edge_edge_lanes_kernel(const double* motions, std::uint32_t count, std::uint32_t next,
                                     std::uint32_t* undecided);

}  // namespace dismantle
