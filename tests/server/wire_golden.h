// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/wire.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

/// One message of each struct and its bytes: golden/wire.json has them for C++ and TypeScript. Every byte of every
/// field is distinct.
namespace dismantle::server::golden {

inline TargetMessage target() {
  return {0x01020304, 0x05060708, {{1.5, -2.25, 1000.125}, {0.5, -0.5, 0.5, 0.5}}};
}

inline RateMessage rate() {
  return {7, 9, {10, -20, 0.5}, {0.25, 0, -3}};
}

inline PoseMessage pose() {
  PoseMessage m;
  m.flags = kStopped | kPlayback;
  m.state = 258;
  m.grip = 3;
  m.answered = 65537;
  m.time = 12.5;
  m.pose = {{-0.1, 0.2, 1e-9}, {0.5, 0.5, -0.5, 0.5}};
  m.clearance = 0.01;
  m.step_us = 123.5f;
  m.steps_per_second = 999;
  m.contacts = {{2, 5, 11, 70000, -0.25f, {1, 2, 3}, {0, 0, 1}}, {4, 1, 0, 8, 0.125f, {-1.5f, 0, 1e6f}, {-1, 0, 0}}};
  return m;
}

inline std::string hex(const std::string& bytes) {
  std::string text;
  char digits[3];
  for (const char c : bytes) {
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(c));
    text += digits;
  }
  return text;
}

inline nlohmann::ordered_json numbers(const Vec3& v) {
  return {v.x, v.y, v.z};
}

inline nlohmann::ordered_json numbers(const Vec3f& v) {
  return {v.x, v.y, v.z};
}

inline nlohmann::ordered_json numbers(const Quat& q) {
  return {q.w, q.x, q.y, q.z};
}

/// The file's content: for each struct its fields by the names of docs/wire.md, and its bytes.
inline nlohmann::ordered_json document() {
  using Json = nlohmann::ordered_json;
  const TargetMessage t = target();
  const RateMessage r = rate();
  const PoseMessage p = pose();
  Json contacts = Json::array();
  for (const ContactMessage& c : p.contacts)
    contacts.push_back({{"moving", c.moving},
                        {"fixed", c.fixed},
                        {"face_moving", c.face_moving},
                        {"face_fixed", c.face_fixed},
                        {"gap", c.gap},
                        {"point", numbers(c.point)},
                        {"normal", numbers(c.normal)}});
  return {{"target",
           {{"grip", t.grip},
            {"number", t.number},
            {"position", numbers(t.pose.position)},
            {"rotation", numbers(t.pose.rotation)},
            {"hex", hex(encode(t))}}},
          {"rate",
           {{"grip", r.grip},
            {"number", r.number},
            {"velocity", numbers(r.velocity)},
            {"angular_velocity", numbers(r.angular_velocity)},
            {"hex", hex(encode(r))}}},
          {"pose",
           {{"flags", p.flags},
            {"state", p.state},
            {"grip", p.grip},
            {"answered", p.answered},
            {"time", p.time},
            {"position", numbers(p.pose.position)},
            {"rotation", numbers(p.pose.rotation)},
            {"clearance", p.clearance},
            {"step_us", p.step_us},
            {"steps_per_second", p.steps_per_second},
            {"contacts", std::move(contacts)},
            {"hex", hex(encode(p))}}}};
}

}  // namespace dismantle::server::golden
