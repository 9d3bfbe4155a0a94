// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/fastener.h"

#include <optional>
#include <string_view>

namespace dismantle {

/// The kind and sizes of a fastener in the name of a component.
struct FastenerName {
  std::optional<Fastener::Kind> kind;             ///< By a word, or by the number of a standard.
  Fastener::Head head = Fastener::Head::None;     ///< None where the name does not say.
  Fastener::Drive drive = Fastener::Drive::None;  ///< None where the name does not say.
  double diameter = 0;                            ///< Of "M5x16" [mm]; 0 where the name does not say.
  double length = 0;                              ///< Of "M5x16" [mm]; 0 where the name does not say.
  /// It is called something else: "lead screw", "nut holder", "roller".
  bool is_other = false;
};

/// Reads a name: English, German, Japanese and Chinese words, abbreviations (SHCS), numbers of ISO and DIN standards,
/// and sizes as "M5x16", "M 5 x 16", "4x20".
FastenerName read_fastener_name(std::string_view name);

}  // namespace dismantle
