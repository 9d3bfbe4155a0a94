// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

/// The program is killed at random moments; what is found afterwards is compared with what docs/faults.md promises.
namespace dismantle::faults {

/// The result of the kills of one kind.
struct KillRow {
  std::string kind;
  int kills = 0;                        ///< All rounds.
  int before_end = 0;                   ///< Rounds in which the program was still running.
  int half_written = 0;                 ///< Outputs that were neither absent nor whole.
  int damaged = 0;                      ///< Outputs from before that were neither as before nor whole.
  int failed_reruns = 0;                ///< Repetitions that failed, or gave another result.
  double longest_loss = 0;              ///< Of a drag: age of the oldest pose that was acknowledged and lost [s].
  int processes_left = 0;               ///< Processes that lived on for more than two seconds.
  int files_left = 0;                   ///< Files that are neither outputs nor results kept for the next run.
  std::set<std::string> names_left;     ///< Their names, with digits replaced by N.
  std::vector<std::string> violations;  ///< A sentence for each broken promise.

  /// True if every promise was kept.
  bool holds() const { return violations.empty(); }
  void violate(int& count, std::string sentence) {
    ++count;
    violations.push_back(kind + ", kill " + std::to_string(kills) + ": " + std::move(sentence));
  }
};

/// The largest loss that is allowed [s].
inline constexpr double kMaxLoss = 1;
/// The time in which the processes of a killed program must end [s].
inline constexpr double kMaxAfterlife = 2;

/// Random numbers of one run of kills.
class KillDice {
 public:
  explicit KillDice(std::uint64_t seed) : random_(seed) {}
  /// Uniform in [lower, upper).
  double between(double lower, double upper) { return std::uniform_real_distribution<double>(lower, upper)(random_); }
  bool toss() { return between(0, 1) < 0.5; }
  /// A moment of a run that takes `duration` [s]: uniform in [0, 1.1 duration], and every second time in its last part,
  /// where outputs are written.
  double moment(double duration) { return duration * (toss() ? between(0, 1.1) : between(0.8, 1.1)); }

 private:
  std::mt19937_64 random_;
};

}  // namespace dismantle::faults
