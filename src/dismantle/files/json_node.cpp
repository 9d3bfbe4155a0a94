// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/json_node.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace dismantle {

using Json = nlohmann::json;

namespace {

Error wrong(const std::string& file, const std::string& why) {
  return {ErrorKind::Unreadable, file + " cannot be used (" + why + "); correct it or write it again"};
}

}  // namespace

Result<Json> parse_json(std::string_view text, const std::string& file_name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_begin = before.rfind('\n') + 1;
    return wrong(file_name, "line " + std::to_string(line) + ", column " +
                                std::to_string(before.size() - line_begin + 1) + ": no well-formed JSON");
  } catch (const Json::exception&) {
    return wrong(file_name, "a number is too large");
  }
}

std::string JsonNode::place() const {
  if (parent == nullptr) return "the document";
  const std::string before = parent->parent == nullptr ? "" : parent->place();
  if (name.empty()) return before + "[" + std::to_string(index) + "]";
  return before.empty() ? std::string(name) : before + "." + std::string(name);
}

void JsonReader::fail(const JsonNode& node, const std::string& why) {
  if (!error_) error_ = wrong(file_name_, node.place() + ": " + why);
}

JsonNode JsonReader::optional_member(const JsonNode& object, std::string_view name) {
  JsonNode node{nullptr, &object, name, 0};
  if (!ok()) return node;
  if (!object.json->is_object()) {
    fail(object, "not an object");
    return node;
  }
  const auto found = object.json->find(name);
  if (found != object.json->end()) node.json = &*found;
  return node;
}

JsonNode JsonReader::member(const JsonNode& object, std::string_view name) {
  JsonNode node = optional_member(object, name);
  if (ok() && node.json == nullptr) fail(node, "missing");
  return node;
}

std::size_t JsonReader::size(const JsonNode& array) {
  if (!ok()) return 0;
  if (array.json->is_array()) return array.json->size();
  fail(array, "not an array");
  return 0;
}

double JsonReader::number(const JsonNode& node) {
  if (!ok()) return 0;
  if (!node.json->is_number()) {
    fail(node, "not a number");
    return 0;
  }
  const double value = node.json->get<double>();
  if (!(std::abs(value) <= kLargestJsonNumber)) fail(node, "beyond 1e9");
  return value;
}

std::string JsonReader::text(const JsonNode& node) {
  if (!ok()) return {};
  if (node.json->is_string()) return node.json->get<std::string>();
  fail(node, "not a text");
  return {};
}

std::vector<std::string> JsonReader::texts(const JsonNode& array) {
  std::vector<std::string> values;
  const std::size_t count = size(array);
  for (std::size_t i = 0; i < count && ok(); ++i) values.push_back(text(array.at(i)));
  return values;
}

int JsonReader::expect_format(const JsonNode& root, std::string_view format, int newest) {
  const JsonNode name = member(root, "format");
  if (text(name) != format && ok()) fail(name, "not \"" + std::string(format) + "\"");
  const JsonNode version = member(root, "version");
  for (int v = 1; v <= newest && ok(); ++v)
    if (*version.json == v) return v;
  fail(version, newest == 1 ? "not 1, the only version that this program knows"
                            : "not 1 to " + std::to_string(newest) + ", the versions that this program knows");
  return newest;
}

}  // namespace dismantle
