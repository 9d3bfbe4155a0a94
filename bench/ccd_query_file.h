// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/narrowphase/ccd_result.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dismantle {

/// The exact result of a query: whether the linear motions meet (closed sets: touching counts).
enum class CcdTruth : std::uint8_t { Miss = 0, Hit = 1, Unknown = 2 };

/// A set of continuous collision queries with their truth (docs/formats.md, `*.ccdq`). One of the two lists is empty.
struct CcdQueryFile {
  std::vector<VertexFaceMotion> vertex_face;  ///< Positions [unit of the file].
  std::vector<EdgeEdgeMotion> edge_edge;      ///< As vertex_face.
  std::vector<CcdTruth> truth;                ///< Shape [query count].
};

/// Reads a query set. Errors (Unreadable): no such file, not a query set, truncated or too long, an unknown type or
/// truth, a coordinate that is not finite.
Result<CcdQueryFile> read_ccdq(const std::filesystem::path& file);

}  // namespace dismantle
