// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"

#include <optional>

namespace dismantle::batch {

/// The result of one item: `result.json` in its folder.
struct BatchResult {
  std::string error;    ///< One sentence; empty: it succeeded.
  std::string summary;  ///< Return value of BatchWork; "{}" if it failed.
  /// True if the item failed.
  bool failed() const { return !error.empty(); }
};

/// The cost of one item: `timing.json`. Apart from the result, because it varies from run to run.
struct BatchTiming {
  double seconds = 0;  ///< Elapsed time [s].
  std::string host;    ///< Name of the host that did the work.
};

/// Reads the result of an item; none if there is none, or its key differs (other input or options).
std::optional<BatchResult> find_result(const BatchJob& job, const BatchItem& item);

/// Writes the result and its cost into `scratch_folder`, and moves that to the item's folder, in place of an outdated
/// one. If another worker has published the item meanwhile, that equal result is kept. Errors: Failed if it cannot be
/// written.
Result<Done> publish_result(const BatchJob& job, const BatchItem& item, const std::filesystem::path& scratch_folder,
                            const BatchResult& result, const BatchTiming& timing);

/// Removes a result, so that the item is processed again.
void remove_result(const BatchJob& job, const BatchItem& item);

/// The tables of a batch.
struct BatchTables {
  std::string json;        ///< Contents of batch.json.
  std::string tsv;         ///< Contents of batch.tsv.
  std::size_t failed = 0;  ///< Number of items that failed.
};

/// Writes batch.json, batch.tsv and timing.tsv to the output folder, with a row for each item in order. The first two
/// do not depend on which worker processed which item. Errors: Failed if a result is missing, or a table cannot be
/// written.
Result<BatchTables> write_tables(const BatchJob& job);

}  // namespace dismantle::batch
