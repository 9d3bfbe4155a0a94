// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/model.h"

#include <nlohmann/json.hpp>

namespace dismantle::server {

using Json = nlohmann::ordered_json;

/// The text of a message; names that are no UTF-8 have their wrong bytes replaced.
std::string text_of(const Json& json);

/// [x, y, z] and [x, y, z, w, x, y, z].
Json to_json(const Vec3& v);
Json to_json(const Pose& pose);
/// The indices.
Json to_json(Span<const ComponentId> components);

/// The event `model` of docs/wire.md.
Json model_json(const Model& model);

/// The part of the event `state` that comes from the session: everything but number, model, hand, search, resumed
/// and resumable.
Json state_json(const Session& session);

/// The answer to `check`.
Json pairs_json(const PairStates& pairs);

}  // namespace dismantle::server
