// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"

#include <utility>

namespace dismantle {

/// Bounds the work of a step where a person drags: some tens of milliseconds where depths are hard to bound, some
/// milliseconds where a set slides along contacts. What is left is done by the next step.
inline void limit_steps(CertificateOptions& options) {
  options.depth_tests = 600;
  options.slide_tests = 400;
  options.node_pairs = 30000;
}

/// Steps to one target of a motion that no hand makes, each of which may end early.
inline constexpr int kMaxStepsToTarget = 600;

/// Makes steps to a target until one is finished. @return the last, with the poses of all
inline StepResult whole_step(MotionEngine& engine, const Pose& target, ResponseKind response) {
  StepResult whole = engine.step(target, response);
  for (int k = 1; k < kMaxStepsToTarget && whole.unfinished; ++k) {
    StepResult next = engine.step(target, response);
    next.poses.insert(next.poses.begin(), whole.poses.begin(), whole.poses.end());
    whole = std::move(next);
  }
  return whole;
}

}  // namespace dismantle
