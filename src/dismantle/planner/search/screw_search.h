// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/thread_fit.h"
#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <vector>

namespace dismantle {

/// A thread that a component shares with another one.
struct NeighbourThread {
  ComponentId neighbour;
  ThreadAxis thread;
};

/// The threads that a component shares with what it touches in the assembled state, whatever their meshes are like:
/// where both surfaces run along each other.
/// @param engine with the component in hand, in its assembled pose
/// @param radius of the component [mm]
std::vector<NeighbourThread> touched_threads(const Assembly& assembly, const CertificateEngine& engine, double radius,
                                             double tolerance);

/// Screws a component out along a thread, one way or the other, until it goes straight on along the axis: the engine
/// lets it slide along the flanks, so that the thread needs to be known only roughly.
/// @param validator what is present stands, nothing is in hand; the same after it
PathSearch screw_out(MotionValidator& validator, const BlockingTable& table, ComponentId component, const ThreadAxis& thread,
                    const KeepGoing& keep_going);

}  // namespace dismantle
