// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/executor.h"

#include <vector>

namespace dismantle {

/// One executor of each kind, and several numbers of threads: all must give the same results.
inline std::vector<Executor> all_executors() {
  return {Executor(ExecutorKind::Serial), Executor(ExecutorKind::Shuffled), Executor(ExecutorKind::Threads, 1),
          Executor(ExecutorKind::Threads, 2), Executor(ExecutorKind::Threads, 7)};
}

}  // namespace dismantle
