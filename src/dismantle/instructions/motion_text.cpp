// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/motion_text.h"

#include "dismantle/math/angle.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dismantle {

namespace {

/// Directions are the same within this sine.
constexpr double kSameDirection = 0.02;
/// A screw turns where it does so by more, in all [rad].
constexpr double kMinTurn = 1e-4;
/// Ways of more legs are not told one by one.
constexpr std::size_t kMaxLegs = 4;

Leg leg_of(const Pose& from, const Pose& to, const Vec3& middle) {
  const Screw screw = screw_between(from, to);
  if (screw.angle > kMinTurn)
    return {screw.axis, dot(screw.velocity, screw.axis), screw.angle, screw_axis_point(screw)};
  const Vec3 way = transform_from_pose(to) * middle - transform_from_pose(from) * middle;
  return {normalized(way), length(way), 0, {}};
}

bool goes_on(const Leg& a, const Leg& b) {
  return (a.angle > 0) == (b.angle > 0) && length(a.direction - b.direction) < kSameDirection;
}

std::string joined_with(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

/// "4.5 times anticlockwise" or "by 30 degrees clockwise"; `outward` is the way's own sense along the axis.
std::string turn_text(const Leg& leg, PathDirection direction) {
  const bool is_forward = direction == PathDirection::Forward;
  const bool anticlockwise = (leg.length >= 0) == is_forward;
  const double turns = leg.angle / kTurn;
  const std::string amount =
      turns >= 0.95 ? number_text(turns) + " times" : "by " + number_text(std::round(360 * turns)) + " degrees";
  return "turn " + amount + (anticlockwise ? " anticlockwise" : " clockwise");
}

std::string leg_text(const Leg& leg, PathDirection direction, bool tells_length) {
  const Vec3 towards = direction == PathDirection::Forward ? leg.direction : -leg.direction;
  if (leg.angle > 0) {
    std::string text = turn_text(leg, direction) + " (seen from where it comes out";
    if (std::abs(leg.length) > 0) text += ", " + number_text(std::abs(leg.length)) + " mm along the axis";
    return text + ")";
  }
  return "straight " + direction_words(towards) + (tells_length ? ", " + number_text(leg.length) + " mm" : "");
}

}  // namespace

std::vector<Leg> legs_of(const RemovalMove& removal, const Vec3& middle) {
  std::vector<Leg> legs;
  for (std::size_t i = 1; i < removal.poses.size(); ++i) {
    const Leg leg = leg_of(removal.poses[i - 1], removal.poses[i], middle);
    if (leg.angle == 0 && leg.length == 0) continue;
    if (legs.empty() || !goes_on(legs.back(), leg)) {
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
  if (legs.empty()) return "It stays where it is.";
  if (legs.size() > kMaxLegs) {
    double length = 0, angle = 0;
    for (const Leg& leg : legs) {
      length += std::abs(leg.length);
      angle += leg.angle;
    }
    return "Along the arrow: " + number_text(length) + " mm in all, turning by " +
           number_text(std::round(360 * angle / kTurn)) + " degrees in all.";
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
  char text[32];
  if (std::abs(value) >= 1000)
    std::snprintf(text, sizeof text, "%.0f", value);
  else
    std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace dismantle
