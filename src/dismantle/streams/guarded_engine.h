// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/vertex_depth_guard.h"
#include "dismantle/streams/sweep_engine.h"

#include <memory>

namespace dismantle {

/// `engine`, with the guard's findings among its contacts; `engine` itself where the guard has nothing to watch.
std::unique_ptr<SweepEngine> make_guarded_engine(std::unique_ptr<SweepEngine> engine, const Assembly& assembly,
                                                 const PairStates& pairs, const Executor& executor);

}  // namespace dismantle
