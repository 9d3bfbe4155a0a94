// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/baselines/append_variants.h"
#include "bench/motion_scenes.h"

#include <vector>

namespace dismantle {

/// What appending cost with one variant.
struct AppendTime {
  AppendVariant variant = AppendVariant::GlobalLock;
  double start_ms = 0;      ///< Of a front that starts from the root: everything is appended. Mean over the steps.
  double update_ms = 0;     ///< Of a front that is kept: little is. Mean over the steps.
  std::size_t started = 0;  ///< Values appended by the last start, all streams together.
  std::size_t updated = 0;  ///< Values appended by the last update.
};

/// Looks at the front of every step of the scene's first move, a start and an update with each variant, one after the
/// other; each `repeats` times, of which the least counts.
std::vector<AppendTime> time_appends(const BenchScene& scene, int cores, int repeats);

}  // namespace dismantle
