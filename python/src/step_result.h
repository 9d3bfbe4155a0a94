// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/motion_engine.h"
#include "python/src/bind.h"

namespace dismantle::python {

/// The result of a step and its assembly, for the names: the class StepResult.
struct StepView {
  std::shared_ptr<const Assembly> assembly;  ///< Never null.
  StepResult result;                         ///< As the engine returned it.
};

/// The response called 'stop', 'touch' or 'slide'. Raises UsageError for other names.
ResponseKind response_of(const std::string& name);

}  // namespace dismantle::python
