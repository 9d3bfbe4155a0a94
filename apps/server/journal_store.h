// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/session.h"

#include <filesystem>
#include <optional>

namespace dismantle::server {

/// The folder with the journals of sessions: for each assembly the one that is being written, and the previous one. For
/// the engine loop's thread.
class JournalStore {
 public:
  /// Without a folder nothing is stored. The folder is created if it is missing.
  explicit JournalStore(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// Gives a new session its journal. If the last session of the assembly crashed, its state is restored. @return true
  /// if it was restored. Errors: Failed if no journal can be written.
  Result<bool> attach(Session& session);
  /// Closes the session's journal; removes it if it is empty.
  void detach(Session& session);
  /// True if a previous session of the assembly is stored.
  bool can_resume(const Session& session) const;
  /// Restores the state of the previous session of the assembly. Errors: Usage if there is none, or this session has
  /// moves or is not idle.
  Result<Done> resume(Session& session) const;

 private:
  std::optional<JournalContents> previous(const Session& session) const;

  std::optional<std::filesystem::path> folder_;
  std::filesystem::path file_;  ///< Journal of the attached session.
};

}  // namespace dismantle::server
