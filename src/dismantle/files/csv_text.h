// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// A field of CSV (RFC 4180): quoted where it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text);
/// A number with 9 significant digits; empty if it is not finite.
std::string csv_field(double number);
/// A whole number.
std::string csv_field(std::size_t number);

/// A row of fields that are already CSV (csv_field), with its line break.
std::string csv_row(const std::vector<std::string>& fields);

/// Texts joined into one: "screw; jaw".
std::string joined(Span<const std::string> texts, std::string_view between = "; ");

}  // namespace dismantle
