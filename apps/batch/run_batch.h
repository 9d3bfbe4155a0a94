// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"
#include "apps/batch/batch_result.h"
#include "apps/batch/batch_worker.h"

namespace dismantle::batch {

struct BatchRunOptions {
  int workers = 1;            ///< Processes that work here.
  bool retry_failed = false;  ///< Retry assemblies that failed.
  BatchReport report;         ///< Called once an item; Found: it was there before the run.
};

/// Has a batch worked through by processes of this machine, together with whoever else works on the same output
/// folder, and writes the tables. Processes that die are started again. Forks: the caller has no threads. Errors:
/// Failed where it was stopped (what is done stays, and is not done again), or the output cannot be written.
Result<BatchTables> run_batch(const BatchJob& job, const BatchRunOptions& options);

}  // namespace dismantle::batch
