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

/// A value of a JSON document and its position in the document. Refers to its parent node, which must outlive it.
struct JsonNode {
  const nlohmann::json* json = nullptr;  ///< The value; null for an absent member.
  const JsonNode* parent = nullptr;      ///< Null for the root.
  std::string_view name;                 ///< Name within an object; empty within an array.
  std::size_t index = 0;                 ///< Index within an array.

  /// Item `i` of an array. @pre it is an array with more than `i` items
  JsonNode at(std::size_t i) const { return {&(*json)[i], this, {}, i}; }
  /// The position for messages: "moves[2].frames[5].rotation"; "the document" for the root.
  std::string place() const;
};

/// Reads values from a JSON document. The first value that is not as required is kept as the Error; every later call
/// returns a default value, so that a reader checks ok() once at the end.
class JsonReader {
 public:
  /// `file_name` is for messages.
  explicit JsonReader(std::string file_name) : file_name_(std::move(file_name)) {}

  /// True until a value was not as required.
  bool ok() const { return !error_; }
  /// The first fault, if any.
  const std::optional<Error>& error() const { return error_; }
  /// Records a fault at `node`, unless there is one already.
  void fail(const JsonNode& node, const std::string& why);

  /// The member of that name; fails if `object` is not an object or has no such member.
  JsonNode member(const JsonNode& object, std::string_view name);
  /// As member(), but its `json` is null if there is no such member.
  JsonNode optional_member(const JsonNode& object, std::string_view name);
  /// The number of items of an array; fails if it is not an array.
  std::size_t size(const JsonNode& array);

  /// A finite number of at most kLargestJsonNumber.
  double number(const JsonNode& node);
  /// A string.
  std::string text(const JsonNode& node);
  /// An array of strings.
  std::vector<std::string> texts(const JsonNode& array);
  /// The version of a document; fails unless it declares `format` and a version from 1 to `newest`.
  int expect_format(const JsonNode& root, std::string_view format, int newest = 1);

 private:
  std::string file_name_;
  std::optional<Error> error_;
};

/// The largest magnitude that JsonReader::number accepts: a thousand kilometres [mm], thirty years [s].
constexpr double kLargestJsonNumber = 1e9;

}  // namespace dismantle
