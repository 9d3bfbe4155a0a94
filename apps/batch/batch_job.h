// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_items.h"

#include "dismantle/core/result.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dismantle::batch {

/// The work on one item, in a process of its own: writes files into `folder` and returns a summary, the text of a flat
/// JSON object whose members become columns of the table. Equal input gives equal files. A crash is reported as a
/// failure of the item.
using BatchWork = std::function<Result<std::string>(const BatchItem& item, const std::filesystem::path& folder)>;

/// Resource limits of one item; exceeding one counts as a failure.
struct BatchLimits {
  double memory_gib = 8;      ///< Memory of the process [GiB].
  double cpu_seconds = 3600;  ///< Processor time of the process [s].
  int attempts = 3;           ///< The item fails after this many workers died while they worked on it.
};

/// A batch. All workers of one output folder need the same one.
struct BatchJob {
  std::vector<BatchItem> items;  ///< In the order of the tables.
  std::filesystem::path output;  ///< The folder with the results.
  BatchWork work;                ///< Done for each item.
  BatchLimits limits;            ///< Of each item.
  double lease_seconds = 120;    ///< A worker that gives no sign of life for this long loses its item [s].

  /// The folder with claims and unfinished results.
  std::filesystem::path work_folder() const { return output / ".batch"; }
};

}  // namespace dismantle::batch
