// SPDX-License-Identifier: Apache-2.0
#include "dismantle/narrowphase/ccd_lanes.h"

#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_lanes_kernel.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Motions per chunk: few enough that those left undecided are still in the second-level cache when they are tested in
/// double.
constexpr std::uint32_t kChunk = 512;

static_assert(sizeof(VertexFaceMotion) == kMotionDoubles * sizeof(double));
static_assert(sizeof(EdgeEdgeMotion) == kMotionDoubles * sizeof(double));

/// Writes the indices of the motions that the lanes cannot prove free to `undecided`; returns their number.
std::uint32_t undecided_by_lanes(const VertexFaceMotion* first, std::uint32_t count, std::uint32_t next,
                                 LaneCount lanes, std::uint32_t* undecided) {
  const double* numbers = &first->vertex_t0.x;
  return with_lanes(lanes,
                    [&](auto width) { return vertex_face_lanes_kernel<width>(numbers, count, next, undecided); });
}

std::uint32_t undecided_by_lanes(const EdgeEdgeMotion* first, std::uint32_t count, std::uint32_t next, LaneCount lanes,
                                 std::uint32_t* undecided) {
  const double* numbers = &first->a_t0[0].x;
  return with_lanes(lanes, [&](auto width) { return edge_edge_lanes_kernel<width>(numbers, count, next, undecided); });
}

CcdResult decided_in_double(const VertexFaceMotion& motion) {
  return ccd_vertex_face(motion);
}

CcdResult decided_in_double(const EdgeEdgeMotion& motion) {
  return ccd_edge_edge(motion);
}

template <class Motion>
CcdBatchResult decide(Span<const Motion> motions, LaneCount lanes) {
  CcdBatchResult result;
  std::uint32_t undecided[kChunk + kMaxLanes];
  for (std::size_t start = 0; start < motions.size(); start += kChunk) {
    const auto up_to_chunk = [&](std::size_t from) {
      return static_cast<std::uint32_t>(std::min<std::size_t>(kChunk, motions.size() - from));
    };
    const std::uint32_t count = up_to_chunk(start), next = up_to_chunk(start + count);
    const std::uint32_t left = undecided_by_lanes(motions.data() + start, count, next, lanes, undecided);
    result.decided_in_double += left;
    for (std::uint32_t i = 0; i < left; ++i) {
      const std::size_t query = start + undecided[i];
      const CcdResult ccd = decided_in_double(motions[query]);
      if (ccd.status == CcdStatus::Contact) result.contacts.push_back({query, ccd});
    }
  }
  return result;
}

}  // namespace

CcdBatchResult ccd_vertex_face_lanes(Span<const VertexFaceMotion> motions, LaneCount lanes) {
  return decide(motions, lanes);
}

CcdBatchResult ccd_edge_edge_lanes(Span<const EdgeEdgeMotion> motions, LaneCount lanes) {
  return decide(motions, lanes);
}

}  // namespace dismantle
