// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/session/timeline.h"

namespace dismantle {

/// The volume swept by a moving set.
struct SweptVolume {
  TriangleMesh mesh;     ///< Closed manifold with outward normals [mm].
  double tolerance = 0;  ///< Maximum distance of any point from the exact swept volume [mm].
};

/// Options of swept_volume().
struct SweptVolumeOptions {
  /// Maximum distance from the exact swept volume [mm]; 0: kSweptShare of the diagonal of its bounding box.
  double tolerance = 0;
  ProgressCallback progress;  ///< Reports and cancels.
};

/// Default tolerance as a fraction of the diagonal.
inline constexpr double kSweptShare = 0.02;

/// The volume swept by the components of a move, closed ones including their interior, from the first frame to the
/// last. Conservative: contains every point of the components at every time, and no point further than the tolerance
/// from one of these. Computed on a grid, so the surface is stepped. Errors: Usage if the tolerance needs more than
/// kMaxSweptCells cells, Failed if cancelled.
Result<SweptVolume> swept_volume(const Assembly& assembly, const TimelineMove& move,
                                 const SweptVolumeOptions& options = {});

/// Maximum number of grid cells, to bound memory.
inline constexpr std::size_t kMaxSweptCells = std::size_t{1} << 27;

}  // namespace dismantle
