// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/frame_json.h"

#include "dismantle/files/text_name.h"

#include <cmath>
#include <limits>
#include <unordered_set>

namespace dismantle {

namespace {

/// Quaternions whose squared length is within this of 1 are kept exactly, so that written paths read back unchanged.
constexpr double kUnitRounding = 8 * std::numeric_limits<double>::epsilon();

Pose read_pose(JsonReader& in, const JsonNode& frame) {
  const JsonNode position = in.member(frame, "position"), rotation = in.member(frame, "rotation");
  if (in.size(position) != 3 && in.ok()) in.fail(position, "not three numbers");
  if (in.size(rotation) != 4 && in.ok()) in.fail(rotation, "not four numbers");
  if (!in.ok()) return {};
  const Vec3 p{in.number(position.at(0)), in.number(position.at(1)), in.number(position.at(2))};
  const Quat q{in.number(rotation.at(0)), in.number(rotation.at(1)), in.number(rotation.at(2)),
               in.number(rotation.at(3))};
  const double squared = dot(q, q);
  if (in.ok() && !(std::abs(std::sqrt(squared) - 1) <= kUnitQuaternionTolerance))
    in.fail(rotation, "not a quaternion of unit length");
  return {p, std::abs(squared - 1) <= kUnitRounding ? q : normalized(q)};
}

}  // namespace

std::vector<std::string> read_component_names(JsonReader& in, const JsonNode& array) {
  std::vector<std::string> names = in.texts(array);
  if (in.ok() && names.empty()) in.fail(array, "no component");
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < names.size() && in.ok(); ++i)
    if (!seen.insert(names[i]).second) in.fail(array.at(i), in_quotes(names[i]) + " is there twice");
  return names;
}

std::vector<Frame> read_frames(JsonReader& in, const JsonNode& array) {
  std::vector<Frame> frames;
  const std::size_t count = in.size(array);
  if (in.ok() && count == 0) in.fail(array, "no frame");
  for (std::size_t i = 0; i < count && in.ok(); ++i) {
    const JsonNode node = array.at(i);
    const JsonNode time = in.member(node, "t");
    const Frame frame{in.number(time), read_pose(in, node)};
    if (in.ok() && i == 0 && frame.time != 0) in.fail(time, "the first is not 0");
    if (in.ok() && i > 0 && frame.time < frames.back().time) in.fail(time, "before the one of the frame before");
    frames.push_back(frame);
  }
  return frames;
}

JsonValue frame_json(const Frame& frame) {
  const Vec3& p = frame.pose.position;
  const Quat& q = frame.pose.rotation;
  return {{"t", frame.time}, {"position", {p.x, p.y, p.z}}, {"rotation", {q.w, q.x, q.y, q.z}}};
}

}  // namespace dismantle
