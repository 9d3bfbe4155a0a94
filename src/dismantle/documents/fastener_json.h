// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/fastener.h"
#include "dismantle/files/json_text.h"

namespace dismantle {

/// A fastener as JSON: docs/formats.md, "Bill of materials".
JsonValue fastener_json(const Fastener& fastener);

}  // namespace dismantle
