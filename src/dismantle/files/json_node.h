// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// Parses JSON text. Errors: Unreadable with line and column.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& file_name);

/// A value of a JSON document and where it stands in it; lives no longer than its parent node.
struct JsonNode {
  const nlohmann::json* json = nullptr;
  const JsonNode* parent = nullptr;
  std::string_view name;  ///< Within an object.
  std::size_t index = 0;  ///< Within an array, where there is no name.

  JsonNode at(std::size_t i) const { return {&(*json)[i], this, {}, i}; }
  /// "moves[2].frames[5].rotation"; "the document" for the root.
  std::string place() const;
};

/// Takes values out of a JSON document; the first thing that is not as wanted is kept as the Error, and everything
/// afterwards gives default values.
class JsonReader {
 public:
  explicit JsonReader(std::string file_name) : file_name_(std::move(file_name)) {}

  bool ok() const { return !error_; }
  const std::optional<Error>& error() const { return error_; }
  void fail(const JsonNode& node, const std::string& why);

  /// The member of that name; fails where `object` is no object or has no such member.
  JsonNode member(const JsonNode& object, std::string_view name);
  /// As member(), but its json is null where there is no such member.
  JsonNode optional_member(const JsonNode& object, std::string_view name);
  /// How many items the array has; fails where it is no array.
  std::size_t size(const JsonNode& array);

  /// A finite number of at most kLargestJsonNumber.
  double number(const JsonNode& node);
  std::string text(const JsonNode& node);
  std::vector<std::string> texts(const JsonNode& array);
  /// Fails where the document does not say that it is `format`, version 1.
  void expect_format(const JsonNode& root, std::string_view format);

 private:
  std::string file_name_;
  std::optional<Error> error_;
};

/// Larger numbers are refused: lengths beyond a thousand kilometres, times beyond thirty years.
constexpr double kLargestJsonNumber = 1e9;

}  // namespace dismantle
