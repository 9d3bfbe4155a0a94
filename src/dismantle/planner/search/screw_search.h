// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/thread_fit.h"
#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/search/local_planner.h"

#include <vector>

namespace dismantle {

/// A thread that a component shares with a neighbour.
struct NeighbourThread {
  ComponentId neighbour;  ///< The other component.
  ThreadAxis thread;      ///< In the assembled state.
};

/// The threads that a component shares with its neighbours in the assembled state, found from opposing faces of both
/// surfaces, whatever the tessellation.
/// @param engine with the component as its moving set, in its assembled pose
/// @param radius of the component [mm]
std::vector<NeighbourThread> touched_threads(const Assembly& assembly, const CertificateEngine& engine, double radius,
                                             double tolerance);

/// Unscrews a component along a thread, in either direction, until it can move straight along the axis. The engine lets
/// it slide along the flanks, so that an approximate thread is enough.
/// @param validator holds the present components, without a moving set; restored afterwards
PathSearch screw_out(MotionValidator& validator, const BlockingTable& table, ComponentId component,
                     const ThreadAxis& thread, const KeepGoing& keep_going);

}  // namespace dismantle
