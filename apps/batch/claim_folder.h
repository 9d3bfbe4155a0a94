// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace dismantle::batch {

/// Somebody works on an item: a symbolic link FOLDER/ITEM.claim.N whose target says who, made in one step that only one
/// can succeed in. N counts the attempts: who finds the latest one's owner dead or silent makes the next.
class Claim {
 public:
  Claim(std::filesystem::path base, int attempt, std::string owner);

  /// 1 where nobody worked on it before; else how many did not come to an end.
  int attempt() const { return attempt_; }
  /// A place for what is being made, of this claim alone. Those of earlier attempts are removed with the claims.
  std::filesystem::path workplace() const { return workplace(attempt_); }
  std::filesystem::path workplace(int attempt) const;
  /// Shows that its owner lives; does so now and then, however often it is called.
  void renew(double lease_seconds);
  /// True if no other worker has taken the item over.
  bool holds() const;
  /// Removes this claim with those before it and their workplaces.
  void release();

 private:
  std::filesystem::path base_;
  int attempt_;
  std::string owner_;
  std::chrono::steady_clock::time_point renewed_;
};

/// The claims of one batch, as one process sees them. Needs nothing of the file system but that a symbolic link is made
/// in one step, so that many hosts can share it. Two may come to work on one item (a host is silent for longer than the
/// lease, and goes on): then their results are the same, and one is dropped.
class ClaimFolder {
 public:
  /// @param lease_seconds Whoever showed no life for so long has lost its item; within one machine that is seen at
  /// once.
  ClaimFolder(std::filesystem::path folder, double lease_seconds);

  /// The claim on an item, where nobody who lives has it.
  std::optional<Claim> take(const std::string& item);

 private:
  struct Seen {
    int attempt = 0;
    std::filesystem::file_time_type changed;
    std::chrono::steady_clock::time_point since;
  };
  bool is_lost(const std::string& item, int attempt, const std::filesystem::path& link);

  std::filesystem::path folder_;
  double lease_seconds_;
  std::string owner_;
  std::map<std::string, Seen> seen_;
};

}  // namespace dismantle::batch
