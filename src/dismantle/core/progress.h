// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace dismantle {

/// Called repeatedly during long work with the name of the current stage and the completed fraction (0 to 1; below 0 if
/// unknown). Returning false cancels: the work stops soon and returns an Error of kind Failed ("cancelled").
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/// Reports to `progress` if there is one. @return false if the work is to be cancelled
inline bool report_progress(const ProgressCallback& progress, std::string_view stage, double fraction) {
  return !progress || progress(stage, fraction);
}

}  // namespace dismantle
