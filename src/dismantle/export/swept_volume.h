// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/session/timeline.h"

namespace dismantle {

/// All that a set passes on its way.
struct SweptVolume {
  TriangleMesh mesh;     ///< Closed, every edge has two faces, normals out [mm].
  double tolerance = 0;  ///< No point of it is further from what is really passed [mm].
};

struct SweptVolumeOptions {
  /// How much larger than what is really passed it may be [mm]; 0: kSweptShare of the diagonal of the box around it.
  double tolerance = 0;
  ProgressCallback progress;
};

inline constexpr double kSweptShare = 0.02;

/// The volume that a move's components pass, solids with their insides, from its first frame to its last. Conservative:
/// it holds every point of them at every time; and no point of it is further than the tolerance from one of these.
/// Found on a grid, whose steps its surface shows. Errors: Usage where the tolerance is too fine for the size
/// (kMaxSweptCells), Failed where it was cancelled.
Result<SweptVolume> swept_volume(const Assembly& assembly, const TimelineMove& move,
                                 const SweptVolumeOptions& options = {});

inline constexpr std::size_t kMaxSweptCells = std::size_t{1} << 27;

}  // namespace dismantle
