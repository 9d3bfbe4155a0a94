// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/fastener_json.h"

namespace dismantle {

JsonValue fastener_json(const Fastener& f) {
  const auto size = [](double value) { return value > 0 ? JsonValue(value) : JsonValue(); };
  return {{"kind", kind_name(f.kind)},
          {"name", kind_text(f)},
          {"designation", designation_text(f)},
          {"head", head_name(f.head)},
          {"drive", drive_name(f.drive)},
          {"drive_size", size(f.drive_size)},
          {"tool", tool_text(f)},
          {"diameter_mm", size(f.diameter)},
          {"length_mm", size(f.length)},
          {"pitch_mm", size(f.pitch)},
          {"thread_is_modelled", f.thread_is_modelled},
          {"left_handed", f.left_handed},
          {"by_name_only", f.by_name_only}};
}

}  // namespace dismantle
