// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <string>

namespace dismantle {

/// What the viewer's page knows of an assembly apart from its shape, as a JSON object: the event `model` of
/// docs/wire.md without `event` and `number`.
std::string viewer_model_json(const Assembly& assembly, double tolerance);

}  // namespace dismantle
