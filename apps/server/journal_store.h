// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/session.h"

#include <filesystem>
#include <optional>

namespace dismantle::server {

/// Where the journals of sessions are kept: of each assembly the one that is being written, and the one before.
class JournalStore {
 public:
  /// Without a folder nothing is kept. The folder is made where it is missing.
  explicit JournalStore(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  /// Gives a new session its journal. Where the last session of the assembly did not end in order, this one goes on
  /// where that was. @return whether it did. Errors: Failed where no journal can be written.
  Result<bool> attach(Session& session);
  /// Ends the session's journal in order; one of nothing is removed.
  void detach(Session& session);
  /// True if there is an earlier session.
  bool can_resume(const Session& session) const;
  /// Goes on where the session before this one was. Errors: Usage where there is none, or something is recorded
  /// already.
  Result<Done> resume(Session& session) const;

 private:
  std::optional<JournalContents> previous(const Session& session) const;

  std::optional<std::filesystem::path> folder_;
  std::filesystem::path file_;  ///< Of the session that is attached.
};

}  // namespace dismantle::server
