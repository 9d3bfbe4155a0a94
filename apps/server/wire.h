// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/rigid_transform.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// The structs of docs/wire.md, protocol `dismantle.1`: their one source. tests/server/golden has their bytes.
namespace dismantle::server {

/// The pose that a pointer or hand asks for.
struct TargetMessage {
  std::uint32_t grip = 0;
  std::uint32_t number = 0;
  Pose pose;
  friend bool operator==(const TargetMessage&, const TargetMessage&) = default;
};

/// The velocity that a 3D mouse or gamepad asks for.
struct RateMessage {
  std::uint32_t grip = 0;
  std::uint32_t number = 0;
  Vec3 velocity;          ///< Of the set's centre [mm/s, world].
  Vec3 angular_velocity;  ///< [rad/s, world]
  friend bool operator==(const RateMessage&, const RateMessage&) = default;
};

/// Where the moving set touches the rest.
struct ContactMessage {
  std::uint32_t moving = 0, fixed = 0;            ///< components
  std::uint32_t face_moving = 0, face_fixed = 0;  ///< of their meshes
  float gap = 0;                                  ///< [mm]
  Vec3f point, normal;                            ///< [mm, world]
  friend bool operator==(const ContactMessage&, const ContactMessage&) = default;
};

/// Flags of a PoseMessage.
enum PoseFlag : std::uint8_t { kReached = 1, kStopped = 2, kPlayback = 4, kAutomatic = 8 };

/// Where the moving set is.
struct PoseMessage {
  std::uint8_t flags = 0;  ///< of PoseFlag
  std::uint32_t state = 0;
  std::uint32_t grip = 0;
  std::uint32_t answered = 0;
  double time = 0;  ///< [s]
  Pose pose;
  double clearance = 0;  ///< [mm]
  float step_us = 0;
  float steps_per_second = 0;
  std::vector<ContactMessage> contacts;  ///< At most kMaxContacts.
  friend bool operator==(const PoseMessage&, const PoseMessage&) = default;
};

inline constexpr std::size_t kTargetBytes = 72, kRateBytes = 64, kPoseBytes = 96, kContactBytes = 48;
inline constexpr std::size_t kMaxContacts = 64;
/// Numbers of a client beyond this are refused: positions [mm], velocities [mm/s].
inline constexpr double kLargestWireNumber = 1e7;

std::string encode(const TargetMessage& message);
std::string encode(const RateMessage& message);
/// @pre at most kMaxContacts contacts
std::string encode(const PoseMessage& message);

/// A client's struct. None where the bytes are no such struct, a number is not finite or larger than
/// kLargestWireNumber, or a rotation is not of unit length within 1e-6; one that is, is scaled to it.
std::optional<std::variant<TargetMessage, RateMessage>> decode_from_client(std::string_view bytes);

/// A server's struct; none where the bytes are not one.
std::optional<PoseMessage> decode_pose(std::string_view bytes);

}  // namespace dismantle::server
