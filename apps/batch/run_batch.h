// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"
#include "apps/batch/batch_result.h"
#include "apps/batch/batch_worker.h"

namespace dismantle::batch {

/// Options of a run.
struct BatchRunOptions {
  int workers = 1;            ///< Number of worker processes.
  bool retry_failed = false;  ///< Retry assemblies that failed.
  BatchReport report;         ///< Called once for each item; Found: the result existed before the run.
};

/// Processes a batch with worker processes, together with other machines that use the same output folder, and writes
/// the tables. Workers that die are restarted. Errors: Failed if it was stopped by SIGINT or SIGTERM (finished results
/// are kept), or the output cannot be written. @pre the process has one thread
Result<BatchTables> run_batch(const BatchJob& job, const BatchRunOptions& options);

}  // namespace dismantle::batch
