// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"
#include "dismantle/streams/sweep_engine.h"

#include <memory>
#include <string_view>

namespace dismantle {

/// Names of the stages in StepCost::stages of a sweeping engine, in this order; their times are those of StageTimings.
///@{
inline constexpr std::string_view kVerticesStage = "vertices";
inline constexpr std::string_view kRefitStage = "bvh_refit";
inline constexpr std::string_view kFrontStage = "front";
inline constexpr std::string_view kIntersectionStage = "intersection_test";
///@}

/// A collision method as the loop of a host program sees it, with responses Stop and Touch. The assembly must outlive
/// the engine. @pre `engine` is of this assembly, all components in the assembled state; tolerance > 0 [mm]
std::unique_ptr<MotionEngine> make_sweeping_motion_engine(const Assembly& assembly, double tolerance,
                                                          std::unique_ptr<SweepEngine> engine);

/// `streams` (docs/design/0004-streams.md) with responses Stop and Touch, all components in the assembled state. The
/// assembly must outlive the engine.
std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options);

}  // namespace dismantle
