// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/motion_text.h"

#include "dismantle/files/number_text.h"
#include "dismantle/math/angle.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Directions that differ by a smaller sine count as equal.
constexpr double kSameDirection = 0.02;
/// Minimum angle of a screw motion; smaller ones count as translations [rad].
constexpr double kMinTurn = 1e-4;
/// Maximum number of legs that are described one by one.
constexpr std::size_t kMaxLegs = 4;
/// Digits of numbers below 1000; larger ones are whole. No digits below the resolution.
constexpr int kDigits = 3, kMaxDigits = 17;
constexpr double kResolution = 1e-4;

Leg leg_of(const Pose& from, const Pose& to, const Vec3& center) {
  const Screw screw = screw_between(from, to);
  if (screw.angle > kMinTurn)
    return {screw.axis, dot(screw.velocity, screw.axis), screw.angle, screw_axis_point(screw)};
  const Vec3 displacement = transform_from_pose(to) * center - transform_from_pose(from) * center;
  return {normalized(displacement), length(displacement), 0, {}};
}

/// True if `b` continues `a` in the same direction or about the same axis.
bool continues(const Leg& a, const Leg& b) {
  return (a.angle > 0) == (b.angle > 0) && length(a.direction - b.direction) < kSameDirection;
}

std::string joined_with(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

/// "rotate 30 degrees clockwise", "unscrew 4.5 turns anticlockwise (seen from the side where it comes out), moving out
/// 4.5 mm".
std::string rotation_text(const Leg& leg, PathDirection direction) {
  const bool is_forward = direction == PathDirection::Forward;
  const bool anticlockwise = (leg.length >= 0) == is_forward;
  const double turns = leg.angle / kTurn;
  const std::string amount = turns >= 0.95 ? number_text(turns) : number_text(std::round(360 * turns));
  std::string text = !is_screwing(leg) ? "rotate " : is_forward ? "unscrew " : "screw in ";
  text += amount + (turns < 0.95 ? " degrees" : amount == "1" ? " turn" : " turns");
  text += anticlockwise ? " anticlockwise" : " clockwise";
  text += is_forward ? " (seen from the side where it comes out)" : " (seen from the side where it goes in)";
  if (std::abs(leg.length) > 0)
    text += (is_forward ? ", moving out " : ", moving in ") + number_text(std::abs(leg.length)) + " mm";
  return text;
}

std::string leg_text(const Leg& leg, PathDirection direction, bool with_length) {
  if (leg.angle > 0) return rotation_text(leg, direction);
  const Vec3 towards = direction == PathDirection::Forward ? leg.direction : -leg.direction;
  return "straight " + direction_words(towards) + (with_length ? " by " + number_text(leg.length) + " mm" : "");
}

}  // namespace

std::vector<Leg> legs_of(const RemovalMove& removal, const Vec3& center) {
  std::vector<Leg> legs;
  for (std::size_t i = 1; i < removal.poses.size(); ++i) {
    const Leg leg = leg_of(removal.poses[i - 1], removal.poses[i], center);
    if (leg.angle == 0 && leg.length == 0) continue;
    if (legs.empty() || !continues(legs.back(), leg)) {
      legs.push_back(leg);
    } else {
      legs.back().length += leg.length;
      legs.back().angle += leg.angle;
    }
  }
  return legs;
}

bool is_screwing(const Leg& leg) {
  return leg.angle >= kTurn / 2 && std::abs(leg.length) > 0;
}

std::string direction_words(const Vec3& unit) {
  static constexpr const char* kWords[3][2] = {{"along -X", "along +X"}, {"along -Y", "along +Y"}, {"down", "up"}};
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(unit[axis]) > 1 - kSameDirection * kSameDirection) return kWords[axis][unit[axis] > 0];
  return "along the arrow";
}

std::string motion_text(const std::vector<Leg>& legs, PathDirection direction) {
  if (legs.empty()) return "No motion.";
  if (legs.size() > kMaxLegs) {
    double length = 0, angle = 0;
    for (const Leg& leg : legs) {
      length += std::abs(leg.length);
      angle += leg.angle;
    }
    return "Follow the arrow: path length " + number_text(length) + " mm, total rotation " +
           number_text(std::round(360 * angle / kTurn)) + " degrees.";
  }
  std::vector<std::string> parts;
  parts.reserve(legs.size());
  for (const Leg& leg : legs) parts.push_back(leg_text(leg, direction, &leg != &legs.back()));
  if (direction == PathDirection::Reversed) std::reverse(parts.begin(), parts.end());
  std::string text = joined_with(parts, ", then ") + ".";
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string number_text(double value) {
  const double whole = std::abs(value) >= 1000 ? 1 : kResolution;
  return number_text(value, std::abs(value) >= 1000 ? kMaxDigits : kDigits, whole);
}

}  // namespace dismantle
