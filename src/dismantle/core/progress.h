// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace dismantle {

/// Called now and then by long work with what it is doing and how far it is (0 to 1; below 0 where unknown).
/// Returning false cancels: the work stops soon and answers with an Error of kind Failed ("cancelled").
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/// Reports to `progress` if there is one; true where the work shall go on.
inline bool report_progress(const ProgressCallback& progress, std::string_view stage, double fraction) {
  return !progress || progress(stage, fraction);
}

}  // namespace dismantle
