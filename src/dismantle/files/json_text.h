// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dismantle {

/// A JSON value whose objects keep the order in which their members were added.
using JsonValue = nlohmann::ordered_json;

/// The value as one line of JSON, with a space after each colon and comma. Numbers are the shortest text that reads
/// back as the same double, bit for bit; bytes that are not UTF-8 are replaced. @pre every number in it is finite
std::string json_line(const JsonValue& value);

/// The items of an array, one a line, each line indented by `indent` spaces: what stands between its brackets, without
/// the last line break. Empty for no items.
std::string json_lines(const std::vector<std::string>& items, int indent);

}  // namespace dismantle
