// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/isolation/isolated_line.h"

#include <functional>
#include <string_view>

namespace dismantle {

/// Work in a child process: gets the request, and writes its result to the channel. It may throw.
using IsolatedWork = std::function<Result<Done>(std::string_view request, IsolatedLine& line)>;

/// The main() of a program that run_isolated() starts: limits and confines this process (confine()) as the parent asked
/// for, runs the work, and sends what comes of it. Returns the exit code; 2, with a sentence on stderr, where no
/// run_isolated() started the process.
int run_isolated_child(const IsolatedWork& work);

}  // namespace dismantle
