// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"
#include "python/src/bind.h"

namespace dismantle::python {

/// The result of a step, with the names of its assembly.
struct StepView {
  std::shared_ptr<const Assembly> assembly;
  StepResult result;
};

/// 'stop', 'touch' or 'slide'.
ResponseKind response_of(const std::string& name);

}  // namespace dismantle::python
