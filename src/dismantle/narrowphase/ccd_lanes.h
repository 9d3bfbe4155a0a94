// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/math/lane_dispatch.h"
#include "dismantle/narrowphase/ccd_result.h"

#include <cstddef>
#include <vector>

namespace dismantle {

/// A motion of a batch that is reported as Contact.
struct CcdBatchContact {
  std::size_t query = 0;  ///< Index in the batch.
  CcdResult ccd;          ///< Result of the test in double; its status is Contact.
};

/// Result and cost of a batch.
struct CcdBatchResult {
  std::vector<CcdBatchContact> contacts;  ///< Ascending by query. All other motions are free.
  std::size_t decided_in_double = 0;      ///< Queries that float could not prove free.
};

/// ccd_vertex_face() of many motions. Most are proved free in lanes of float; the others are decided by
/// ccd_vertex_face().
///   1. A motion that is not among the contacts is certainly free (property 1 of ccd_vertex_face), despite rounding.
///   2. A contact is one of ccd_vertex_face, with the same result: its properties 2 and 3 hold.
///   3. The result is the same, bit for bit, for every lane count.
/// No false negative by proof: docs/design/0005-lanes.md.
/// @param lanes number of lanes, one of lane_counts()
/// @pre positions are finite
CcdBatchResult ccd_vertex_face_lanes(Span<const VertexFaceMotion> motions, LaneCount lanes = widest_lanes());

/// ccd_edge_edge() of many motions, with the guarantees of ccd_vertex_face_lanes().
CcdBatchResult ccd_edge_edge_lanes(Span<const EdgeEdgeMotion> motions, LaneCount lanes = widest_lanes());

}  // namespace dismantle
