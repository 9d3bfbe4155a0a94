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

/// Makes a MotionEngine with responses Stop and Touch of a SweepEngine. @param assembly must outlive the result
/// @param tolerance of the pairs [mm] @pre positive
/// @param engine of this assembly, with all components in the assembled state
std::unique_ptr<MotionEngine> make_sweeping_motion_engine(const Assembly& assembly, double tolerance,
                                                          std::unique_ptr<SweepEngine> engine);

/// Makes the method `streams` (docs/design/0004-streams.md) with responses Stop and Touch, on the threads of the
/// options' executor, with all components in the assembled state. @param assembly must outlive the engine
std::unique_ptr<MotionEngine> make_streams_motion_engine(const Assembly& assembly, const PairStates& pairs,
                                                         const CollisionOptions& options);

}  // namespace dismantle
