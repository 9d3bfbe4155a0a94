// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/batch/batch_items.h"

#include "dismantle/core/result.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dismantle::batch {

/// The work on one item, in a process of its own: writes its files into `folder` and returns a summary, the text
/// of a flat JSON object that the table has as a row. Same input, same files. It may crash.
using BatchWork = std::function<Result<std::string>(const BatchItem& item, const std::filesystem::path& folder)>;

/// Resource limits of one item; exceeding one counts as a failure.
struct BatchLimits {
  double memory_gib = 8;
  double cpu_seconds = 3600;
  int attempts = 3;  ///< Of processes that died over it, for whatever reason.
};

/// A batch as all who work on it see it.
struct BatchJob {
  std::vector<BatchItem> items;
  std::filesystem::path output;
  BatchWork work;
  BatchLimits limits;
  double lease_seconds = 120;  ///< A machine that is silent for so long has lost its item.

  /// Where claims and what is being made are.
  std::filesystem::path workshop() const { return output / ".batch"; }
};

}  // namespace dismantle::batch
