// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/files/json_node.h"
#include "dismantle/files/json_text.h"

#include <string>
#include <vector>

namespace dismantle {

/// The largest deviation of a quaternion's length from 1 that a reader accepts; it is then normalised.
constexpr double kUnitQuaternionTolerance = 1e-6;

/// Reads component names: at least one, no repeats.
std::vector<std::string> read_component_names(JsonReader& in, const JsonNode& array);

/// Reads frames (docs/formats.md): at least one, t from 0 and never decreasing, unit quaternions.
std::vector<Frame> read_frames(JsonReader& in, const JsonNode& array);

/// A frame as a JSON object with t, position and rotation (docs/formats.md).
JsonValue frame_json(const Frame& frame);

}  // namespace dismantle
