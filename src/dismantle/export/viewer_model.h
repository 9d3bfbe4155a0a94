// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <string>

namespace dismantle {

/// Metadata of an assembly for the viewer, as a JSON object: the event `model` of docs/wire.md without `event` and
/// `number`. @param tolerance depth that counts as touching [mm]
std::string viewer_model_json(const Assembly& assembly, double tolerance);

}  // namespace dismantle
