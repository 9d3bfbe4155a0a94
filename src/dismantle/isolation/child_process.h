// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/isolation/isolated_line.h"
#include "dismantle/isolation/isolated_process.h"

#include <sys/types.h>

#include <functional>

namespace dismantle {

// What a program of its own (run_isolated()) and a fork (run_forked()) have in common.

/// The exit codes of a child; every other one is a crash.
inline constexpr int kExitDone = 0, kExitOutOfMemory = 17, kExitException = 18;

/// In the parent: receives until the child ends; kills it if it is silent, cancelled, or sends malformed messages or
/// more than it could have held. `descriptor` is the end of the channel to read from.
IsolatedResult listen_to_child(pid_t child, int descriptor, const IsolationLimits& limits,
                               const ProgressCallback& progress);

/// In the child: makes it die with its parent. False if the parent, a process, has died already.
bool follow_parent(pid_t parent);

/// In the child: sets its limits, and lets it leave no core file.
void set_limits(const IsolationLimits& limits);

/// In the child: does the work and tells the parent what came of it. Returns the exit code.
int work_for_parent(const std::function<Result<Done>(IsolatedLine&)>& work, int descriptor);

}  // namespace dismantle
