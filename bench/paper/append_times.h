// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/baselines/append_variants.h"
#include "bench/motion_scenes.h"

#include <iterator>
#include <vector>

namespace dismantle {

/// Times of appending with one variant.
struct AppendTime {
  AppendVariant variant = AppendVariant::GlobalLock;
  double start_ms = 0;      ///< A front that starts from the root: everything is appended. Mean over the steps.
  double update_ms = 0;     ///< A front that is updated: little is appended. Mean over the steps.
  std::size_t started = 0;  ///< Values appended by the last start, all streams together.
  std::size_t updated = 0;  ///< Values appended by the last update.
};

/// Settings of time_appends().
struct AppendRuns {
  std::vector<AppendVariant> variants;  ///< In this order; empty: all that differ on the CPU or the device.
  bool on_device = false;               ///< On the CUDA device instead of `cores`.
  int cores = 1;                        ///< Threads on the CPU.
  int repeats = 1;                      ///< Of each launch; the shortest time counts.
};

/// Sprouts the front of every step of the scene's first move with each variant in turn: from the root, and from the
/// front of the step before. Errors: Failed where there is no CUDA device to run on.
Result<std::vector<AppendTime>> time_appends(const BenchScene& scene, const AppendRuns& runs);

}  // namespace dismantle
