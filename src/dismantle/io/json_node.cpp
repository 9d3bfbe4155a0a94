// SPDX-License-Identifier: Apache-2.0
#include "dismantle/io/json_node.h"

#include "dismantle/io/mesh_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace dismantle {

using Json = nlohmann::json;

namespace {

/// Quaternions this near to unit length (squared) keep their bits, so that what was written reads back the same.
constexpr double kUnitRounding = 8 * std::numeric_limits<double>::epsilon();

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

std::vector<std::string> JsonReader::component_names(const JsonNode& array) {
  std::vector<std::string> names = texts(array);
  if (ok() && names.empty()) fail(array, "no component");
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < names.size() && ok(); ++i)
    if (!seen.insert(names[i]).second) fail(array.at(i), in_quotes(names[i]) + " is there twice");
  return names;
}

Pose JsonReader::pose(const JsonNode& frame) {
  const JsonNode position = member(frame, "position"), rotation = member(frame, "rotation");
  if (size(position) != 3 && ok()) fail(position, "not three numbers");
  if (size(rotation) != 4 && ok()) fail(rotation, "not four numbers");
  if (!ok()) return {};
  const Vec3 p{number(position.at(0)), number(position.at(1)), number(position.at(2))};
  const Quat q{number(rotation.at(0)), number(rotation.at(1)), number(rotation.at(2)), number(rotation.at(3))};
  const double squared = dot(q, q);
  if (ok() && !(std::abs(std::sqrt(squared) - 1) <= kUnitQuaternionTolerance))
    fail(rotation, "not a quaternion of unit length");
  return {p, std::abs(squared - 1) <= kUnitRounding ? q : normalized(q)};
}

std::vector<Frame> JsonReader::frames(const JsonNode& array) {
  std::vector<Frame> frames;
  const std::size_t count = size(array);
  if (ok() && count == 0) fail(array, "no frame");
  for (std::size_t i = 0; i < count && ok(); ++i) {
    const JsonNode node = array.at(i);
    const JsonNode time = member(node, "t");
    const Frame frame{number(time), pose(node)};
    if (ok() && i == 0 && frame.time != 0) fail(time, "the first is not 0");
    if (ok() && i > 0 && frame.time < frames.back().time) fail(time, "before the one of the frame before");
    frames.push_back(frame);
  }
  return frames;
}

void JsonReader::expect_format(const JsonNode& root, std::string_view format) {
  const JsonNode name = member(root, "format");
  if (text(name) != format && ok()) fail(name, "not \"" + std::string(format) + "\"");
  const JsonNode version = member(root, "version");
  if (ok() && *version.json != 1) fail(version, "not 1, the only version that this program knows");
}

std::string json_text(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string json_text(double number) {
  DISMANTLE_EXPECT(std::isfinite(number));
  if (number == 0 && std::signbit(number)) return "-0.0";  // "-0" reads back as the integer 0
  char buffer[32];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), number);
  DISMANTLE_ENSURE(error == std::errc{});
  return {buffer, end};
}

std::string json_text(const std::vector<std::string>& texts) {
  std::string result = "[";
  for (const std::string& text : texts) result += (result.size() > 1 ? ", " : "") + json_text(text);
  return result + "]";
}

std::string json_text(const Frame& frame) {
  const Vec3& p = frame.pose.position;
  const Quat& q = frame.pose.rotation;
  return "{\"t\": " + json_text(frame.time) + ", \"position\": [" + json_text(p.x) + ", " + json_text(p.y) + ", " +
         json_text(p.z) + "], \"rotation\": [" + json_text(q.w) + ", " + json_text(q.x) + ", " + json_text(q.y) + ", " +
         json_text(q.z) + "]}";
}

}  // namespace dismantle
