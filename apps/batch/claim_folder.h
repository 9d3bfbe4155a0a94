// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace dismantle::batch {

/// A worker's claim on an item: a symbolic link FOLDER/ITEM.claim.N whose target names the worker. Creating a link is
/// atomic, so only one worker succeeds. N counts the attempts: a worker that finds the latest owner dead or silent
/// creates the next.
class Claim {
 public:
  /// The claim whose link exists. @param base FOLDER/ITEM
  Claim(std::filesystem::path base, int attempt, std::string owner);

  /// Number of the attempt, from 1; the earlier ones did not finish.
  int attempt() const { return attempt_; }
  /// A folder for the unfinished result, used by this claim only.
  std::filesystem::path scratch_folder() const { return scratch_folder(attempt_); }
  /// The same for another attempt.
  std::filesystem::path scratch_folder(int attempt) const;
  /// Gives a sign of life by touching the link, at most ten times a lease.
  void renew(double lease_seconds);
  /// True unless another worker has taken over the item.
  bool is_held() const;
  /// Removes this claim and the earlier ones, with their scratch folders.
  void release();

 private:
  std::filesystem::path base_;
  int attempt_;
  std::string owner_;
  std::chrono::steady_clock::time_point renewed_;
};

/// The claims of one batch, used by one process. The only requirement on the file system is that symbolic links are
/// created atomically, so many hosts can share it. Two workers may process one item (a host is silent for longer than
/// the lease, then continues): their results are equal, and one is dropped.
class ClaimFolder {
 public:
  /// @param lease_seconds an owner without a sign of life for this long has lost its item [s]; a process of the same
  /// machine that has ended loses it at once
  ClaimFolder(std::filesystem::path folder, double lease_seconds);

  /// Claims an item; none if a live worker has it.
  std::optional<Claim> try_claim(const std::string& item);
  /// Removes what processes of this machine that have ended left: claims with their scratch folders, and replaced
  /// results.
  void remove_abandoned() const;

 private:
  struct Seen {
    int attempt = 0;
    std::filesystem::file_time_type changed;
    std::chrono::steady_clock::time_point since;
  };
  bool is_expired(const std::string& item, int attempt, const std::filesystem::path& link);

  std::filesystem::path folder_;
  double lease_seconds_;
  std::string owner_;
  std::map<std::string, Seen> seen_;
};

}  // namespace dismantle::batch
