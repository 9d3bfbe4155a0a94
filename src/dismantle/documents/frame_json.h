// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/files/json_node.h"
#include "dismantle/files/json_text.h"

#include <string>
#include <vector>

namespace dismantle {

/// How far a quaternion's length may be off 1; it is scaled to 1 where it is off at all.
constexpr double kUnitQuaternionTolerance = 1e-6;

/// At least one component name, none twice; else the reader fails.
std::vector<std::string> read_component_names(JsonReader& in, const JsonNode& array);

/// Frames as docs/formats.md has them: at least one, t from 0 on and never decreasing, unit quaternions; else the
/// reader fails.
std::vector<Frame> read_frames(JsonReader& in, const JsonNode& array);

/// The members t, position and rotation of a frame as docs/formats.md has them.
JsonValue frame_json(const Frame& frame);

}  // namespace dismantle
