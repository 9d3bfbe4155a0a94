// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"

#include <nlohmann/json.hpp>

namespace dismantle::server {

/// JSON that keeps the order of members.
using Json = nlohmann::ordered_json;

/// The text of a message, in one line; bytes that are not UTF-8 are replaced.
std::string text_of(const Json& json);

/// The array [x, y, z].
Json to_json(const Vec3& v);
/// The array [x, y, z, w, x, y, z]: position [mm] and quaternion.
Json to_json(const Pose& pose);
/// The array of the components' indices.
Json to_json(Span<const ComponentId> components);

/// The event `model` of docs/wire.md. @pre the model is loaded
Json model_json(const Model& model);

/// The members of the event `state` that depend on the session only: all but number, model, hand, search, resumed and
/// resumable.
Json state_json(const Session& session);

/// The members of the reply to `check`.
Json clashes_json(const Clashes& clashes);

}  // namespace dismantle::server
