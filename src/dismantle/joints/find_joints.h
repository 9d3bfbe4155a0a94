// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/exec/executor.h"
#include "dismantle/fasteners/fastener.h"
#include "dismantle/joints/joint.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The joints of an assembly by its threaded fasteners, in the order of their screws, then of nuts on studs. From
/// sections across the axis of each fastener in the assembled state:
/// - A component is held if the shank passes through it: on at least half of the rays from the axis its material begins
///   within 1.35 times the radius of the shank, at some plane between the tip and the head. So is one on which the head
///   presses just below it, and one that the tip of a set screw touches.
/// - A nut, washer, threaded insert or standoff is one by `fasteners`; a nut and a washer that the shank passes through
///   come off with it.
/// - What is inside the box of a nut, the insert of a lock nut, belongs to the nut.
/// - The thread ends in the nut, insert, standoff or component with a hole no wider than the thread that is nearest to
///   the tip; if there is none, in what is nearest to the tip. That of a screw without a head is in the one nearest to
///   its other end. It is left after the distance from the tip to the end of that hole towards the head.
/// - A nut without a recognised screw is on the component that fills its hole, and holds that and what it, or its
///   washer, presses on.
/// Not known: forces, how far a thread that is not modelled reaches, what only friction, glue or a wide washer holds,
/// plates in the middle of a stack with a hole much wider than the shank, and what rivets, dowels, circlips and
/// fasteners that were not recognised hold. A heuristic for the order of steps, not for collisions. Deterministic.
/// @param fasteners find_fasteners(). Shape [component_count].
std::vector<Joint> find_joints(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners,
                               const Executor& executor);

}  // namespace dismantle
