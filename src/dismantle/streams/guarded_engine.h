// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/vertex_depth_guard.h"
#include "dismantle/streams/sweep_engine.h"

#include <memory>

namespace dismantle {

/// Adds a VertexDepthGuard to `engine`: vertices that get too deep block sweeps, too. Returns `engine` itself if there
/// is nothing to watch. @param assembly must outlive the result
std::unique_ptr<SweepEngine> make_guarded_engine(std::unique_ptr<SweepEngine> engine, const Assembly& assembly,
                                                 const PairStates& pairs, const Executor& executor);

}  // namespace dismantle
