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

/// The structs of docs/wire.md, protocol `dismantle.1`: their only source. tests/server/golden has their bytes.
namespace dismantle::server {

/// The target pose of the dragged set, from a pointer or a tracked hand.
struct TargetMessage {
  std::uint32_t grip = 0;    ///< Of the drag: from the reply to `hold`.
  std::uint32_t number = 0;  ///< Counts the inputs of a drag from 1.
  Pose pose;                 ///< The target [mm].
  /// True if all members are equal.
  friend bool operator==(const TargetMessage&, const TargetMessage&) = default;
};

/// The target velocity of the dragged set, from a 3D mouse or gamepad.
struct RateMessage {
  std::uint32_t grip = 0;    ///< As in TargetMessage.
  std::uint32_t number = 0;  ///< As in TargetMessage.
  Vec3 velocity;             ///< Of the set's centre [mm/s, world].
  Vec3 angular_velocity;     ///< [rad/s, world]
  /// True if all members are equal.
  friend bool operator==(const RateMessage&, const RateMessage&) = default;
};

/// An input of a drag.
using DragInput = std::variant<TargetMessage, RateMessage>;

/// A contact of the moving set with another component.
struct ContactMessage {
  std::uint32_t moving = 0;       ///< Component of the moving set.
  std::uint32_t fixed = 0;        ///< The other component.
  std::uint32_t face_moving = 0;  ///< Face of the mesh of `moving`.
  std::uint32_t face_fixed = 0;   ///< Face of the mesh of `fixed`.
  float gap = 0;                  ///< Along the normal [mm]; negative: overlap.
  Vec3f point;                    ///< [mm, world]
  Vec3f normal;                   ///< Unit, from the fixed to the moving component [world].
  /// True if all members are equal.
  friend bool operator==(const ContactMessage&, const ContactMessage&) = default;
};

/// Flags of a PoseMessage.
enum PoseFlag : std::uint8_t {
  kReached = 1,    ///< The target is reached.
  kStopped = 2,    ///< Stopped by contact.
  kPlayback = 4,   ///< Part of a playback.
  kAutomatic = 8,  ///< Part of an automatic motion.
};

/// The current pose of the moving set.
struct PoseMessage {
  std::uint8_t flags = 0;                ///< Combination of PoseFlag.
  std::uint32_t state = 0;               ///< Number of the event `state` that it belongs to.
  std::uint32_t grip = 0;                ///< Of the drag; 0: none.
  std::uint32_t answered = 0;            ///< Number of the last processed input of the drag; 0: none.
  double time = 0;                       ///< Of the playback, otherwise since the grab [s].
  Pose pose;                             ///< [mm]
  double clearance = 0;                  ///< Lower bound of the distance to all other components [mm]; NaN: unknown.
  float step_us = 0;                     ///< Duration of the step [us].
  float steps_per_second = 0;            ///< Steps of the engine in the last second.
  std::vector<ContactMessage> contacts;  ///< At most kMaxContacts, smallest gap first.
  /// True if all members are equal.
  friend bool operator==(const PoseMessage&, const PoseMessage&) = default;
};

inline constexpr std::size_t kTargetBytes = 72;   ///< Size of an encoded TargetMessage [bytes].
inline constexpr std::size_t kRateBytes = 64;     ///< Size of an encoded RateMessage [bytes].
inline constexpr std::size_t kPoseBytes = 96;     ///< Size of an encoded PoseMessage without contacts [bytes].
inline constexpr std::size_t kContactBytes = 48;  ///< Size of an encoded ContactMessage [bytes].
/// Maximum number of contacts of a PoseMessage.
inline constexpr std::size_t kMaxContacts = 64;
/// Larger numbers of a client are rejected: positions [mm], velocities [mm/s].
inline constexpr double kMaxWireNumber = 1e7;

/// The bytes of a struct `target`.
std::string encode(const TargetMessage& message);
/// The bytes of a struct `rate`.
std::string encode(const RateMessage& message);
/// The bytes of a struct `pose`. @pre at most kMaxContacts contacts
std::string encode(const PoseMessage& message);

/// Decodes a struct of a client. None if the bytes are not a valid struct, a number is not finite or larger than
/// kMaxWireNumber, or the length of a quaternion differs from 1 by more than 1e-6. Quaternions are normalized.
std::optional<DragInput> decode_from_client(std::string_view bytes);

/// Decodes a struct `pose`; none if the bytes are not one.
std::optional<PoseMessage> decode_pose(std::string_view bytes);

}  // namespace dismantle::server
