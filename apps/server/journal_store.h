// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/session.h"

#include <filesystem>
#include <optional>
#include <string>

namespace dismantle::server {

/// The part of a session that was restored.
struct RestoredSession {
  bool is_restored = false;  ///< The session has its entries.
  std::string warning;       ///< One sentence if a part of it is no valid state and was left out; else empty.
};

/// The folder with the journals of sessions: for each assembly the one that is being written, and the previous one. For
/// the engine loop's thread.
class JournalStore {
 public:
  /// Without a folder nothing is stored. The folder is created if it is missing.
  explicit JournalStore(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// Gives a new session its journal. If the last session of the assembly crashed, its last valid state is restored; a
  /// journal with invalid records is kept beside it as *.invalid. Errors: Failed if no journal can be written.
  Result<RestoredSession> attach(Session& session);
  /// Closes the session's journal; removes it if it is empty.
  void detach(Session& session);
  /// True if a previous session of the assembly is stored.
  bool can_resume(const Session& session) const;
  /// Restores the last valid state of the previous session of the assembly. Errors: Usage if there is none, or this
  /// session has moves or is not idle.
  Result<RestoredSession> resume(Session& session) const;

 private:
  std::optional<JournalContents> previous(const Session& session) const;

  std::optional<std::filesystem::path> folder_;
  std::filesystem::path file_;  ///< Journal of the attached session.
};

}  // namespace dismantle::server
