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
/// With 9 significant digits; empty where it is not finite.
std::string csv_field(double number);
std::string csv_field(std::size_t number);

/// Fields as a row, with its line break.
std::string csv_row(const std::vector<std::string>& fields);

/// Texts in one field: "screw; jaw".
std::string joined(Span<const std::string> texts, std::string_view between = "; ");

}  // namespace dismantle
