// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/session_json.h"
#include "dismantle/core/result.h"
#include "dismantle/planner/step_preference.h"
#include "dismantle/session/session.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dismantle::server {

/// An error of kind Usage: "<problem> (<why>); <advice>".
Error usage(const std::string& problem, const std::string& why, const std::string& advice);

/// The members of a command. Errors: Usage, with the name of a member that is missing or of a wrong type.
class Arguments {
 public:
  /// @param command must outlive this
  Arguments(const Json& command, std::size_t component_count) : command_(command), component_count_(component_count) {}

  /// The command itself.
  const Json& command() const { return command_; }
  /// The member `components`, with at least one component.
  Result<std::vector<ComponentId>> components() const;
  /// A list of components; empty if it is missing.
  Result<std::vector<ComponentId>> list(const char* name) const;
  /// The member `prefer`, the most important first; empty if it is missing.
  Result<ChosenPreferences> preferences() const;
  /// The member `effort`, above 0 and at most kMaxEffort; 1 if it is missing.
  Result<double> effort() const;
  /// The member `direction`; none if it is missing or null.
  Result<std::optional<Vec3>> direction() const;
  /// A number that is not too large for the wire.
  Result<double> number(const char* name) const;
  /// A string.
  Result<std::string> text(const char* name) const;
  /// A string of at most kMaxText bytes; empty if it is missing.
  Result<std::string> optional_text(const char* name) const;
  /// One of some strings; the first if it is missing.
  Result<std::string> choice(const char* name, const std::vector<std::string>& choices) const;
  /// True or false; false if it is missing.
  Result<bool> flag(const char* name) const;
  /// An integer from 0.
  Result<std::uint64_t> index(const char* name) const;
  /// The member `source`; the recording if it is missing.
  Result<PlaybackSource> source() const;
  /// The member `response`.
  Result<ResponseKind> response() const;

  static constexpr std::size_t kMaxText = 1000;  ///< Limit of optional_text() [bytes].
  static constexpr double kMaxEffort = 1000;     ///< Limit of effort().

 private:
  const Json& command_;
  std::size_t component_count_;
};

}  // namespace dismantle::server
