// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/clash.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/exec/executor.h"

namespace dismantle {

/// Options of find_clashes().
struct ClashOptions {
  double tolerance = 0;       ///< Depth that counts as touching [mm]; 0: default_tolerance(assembly).
  double clearance = 0;       ///< Pairs that are apart by less than this are Near [mm].
  bool volumes = true;        ///< Finds what pairs have in common, and which contain others, too.
  Executor executor;          ///< Runs the pairs; the result does not depend on it.
  ProgressCallback progress;  ///< Called under a lock, from any thread; false cancels.
};

/// All pairs of components that touch, overlap or are near in the assembled state: how far apart or how deep they are
/// (solid_depth(), to within 1% or a tenth of the tolerance), where, and the volume that they have in common
/// (common_volume()). A pair is Overlapping if its depth is above the tolerance; where
/// the search for the depth ended early, if a point was found that is deeper. The result depends on the assembly and
/// the options alone. Errors: Failed where `progress` cancelled.
Result<Clashes> find_clashes(const Assembly& assembly, const ClashOptions& options = {});

}  // namespace dismantle
