// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_job.h"

#include <optional>

namespace dismantle::batch {

/// The result of one item: `result.json` in its folder.
struct BatchResult {
  std::string error;    ///< One sentence; empty where it was done.
  std::string summary;  ///< What BatchWork returned; "{}" where it failed.
  bool failed() const { return !error.empty(); }
};

/// The cost of one item, which varies from run to run and so is not part of the result: `timing.json`.
struct BatchTiming {
  double seconds = 0;
  std::string host;
};

/// The result of an item as it is now; nothing where there is none, or one of another input or other options.
std::optional<BatchResult> find_result(const BatchJob& job, const BatchItem& item);

/// Completes what was made in `workplace` and makes it the item's result folder, in the place of an older one. Where
/// somebody else has done so meanwhile, theirs stays, which is the same. Errors: Failed where it cannot be written.
Result<Done> publish_result(const BatchJob& job, const BatchItem& item, const std::filesystem::path& workplace,
                            const BatchResult& result, const BatchTiming& timing);

/// Takes a result away, so that the item is done again.
void remove_result(const BatchJob& job, const BatchItem& item);

/// The outcome of a batch.
struct BatchTables {
  std::string json;  ///< batch.json
  std::string tsv;   ///< batch.tsv
  std::size_t failed = 0;
};

/// The tables of all results, in the order of the items: the same bytes whoever did what. Writes them to the output
/// folder, and timing.tsv. Errors: Failed where a result is not there any more, or they cannot be written.
Result<BatchTables> write_tables(const BatchJob& job);

}  // namespace dismantle::batch
