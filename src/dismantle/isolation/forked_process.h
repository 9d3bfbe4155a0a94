// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/isolation/isolated_line.h"
#include "dismantle/isolation/isolated_process.h"

#include <functional>

namespace dismantle {

/// As run_isolated(), but the child is a fork of this process, which sees its memory as it is and may do what it may:
/// for our own work that needs limits, not for what came from elsewhere. It has none of the parent's files and sockets.
/// `work` may throw. @pre the process has one thread
IsolatedResult run_forked(const std::function<Result<Done>(IsolatedLine&)>& work, const IsolationLimits& limits,
                          const ProgressCallback& progress);

}  // namespace dismantle
