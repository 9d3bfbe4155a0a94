// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/narrowphase/ccd_result.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dismantle {

/// What is known about a query: whether the exact linear motions meet (closed sets: touching counts).
enum class CcdTruth : std::uint8_t { Miss = 0, Hit = 1, Unknown = 2 };

/// A set of continuous collision queries with their truth (FORMATS, `*.ccdq`). One of the two lists is empty.
struct CcdQueryFile {
  std::vector<VertexFaceMotion> vertex_face;  ///< Positions [unit of the file].
  std::vector<EdgeEdgeMotion> edge_edge;
  std::vector<CcdTruth> truth;  ///< Shape [query count].
};

/// Reads a query set. Errors (Unreadable): no such file, not a query set, cut short or too long, an unknown type or
/// truth, a coordinate that is not finite.
Result<CcdQueryFile> read_ccdq(const std::filesystem::path& file);

}  // namespace dismantle
