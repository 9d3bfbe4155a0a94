// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"

#include <cstdint>
#include <functional>

namespace dismantle::batch {

/// Origin of a result.
enum class BatchProgress : std::uint32_t {
  Found,  ///< It existed, or another worker made it.
  Made,   ///< This worker made it.
};

/// Called with the index of each item when its result exists.
using BatchReport = std::function<void(std::uint32_t item, BatchProgress progress)>;

/// Processes the items that no other worker has claimed, the largest first, until all have results or a stop is
/// requested; then the unfinished item is dropped. Any number of workers, on any number of machines, may share one
/// output folder. Forks for each item. Errors: Failed if results cannot be written. @pre the process has one thread
Result<Done> run_worker(const BatchJob& job, const BatchReport& report);

}  // namespace dismantle::batch
