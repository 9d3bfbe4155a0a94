// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"

#include <cstdint>
#include <functional>

namespace dismantle::batch {

/// The origin of a result.
enum class BatchProgress : std::uint32_t {
  Found,  ///< It was there, or somebody else made it.
  Made,
};

/// Called with an item's index where its result is there.
using BatchReport = std::function<void(std::uint32_t item, BatchProgress progress)>;

/// Works on the items, the largest first, that nobody else works on, until all have their results or a stop is
/// requested; then what was begun is dropped. Any number of workers, on any number of machines, may do so for one
/// output folder. Forks for each item: the caller has no threads. Errors: Failed where results cannot be written.
Result<Done> work_through(const BatchJob& job, const BatchReport& report);

}  // namespace dismantle::batch
