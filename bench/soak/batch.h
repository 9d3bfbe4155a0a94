// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/assembly/path.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/session/play_motion.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

/// Random drags over assemblies, every path audited (bench/soak_motion.cpp).
namespace dismantle::soak {

/// Settings of a batch.
struct BatchOptions {
  int targets = 50;           ///< Of a drag.
  int threads = 1;            ///< Of the engine.
  double audit_seconds = 60;  ///< After which an audit is cut.
};

/// Number of drags of a batch, each of another random component.
inline constexpr int kDragsPerBatch = 3;

/// Times of steps, in bins that are 5% wide.
class TimeHistogram {
 public:
  void add(double us) { ++bins_[bin_of(us)]; }
  void add(const TimeHistogram& other);
  void add(int bin, std::size_t count) { bins_[bin] += count; }
  /// The q-th quantile [us], to within a bin; 0 of no steps.
  double quantile(double q) const;
  const std::map<int, std::size_t>& bins() const { return bins_; }

 private:
  static int bin_of(double us);
  std::map<int, std::size_t> bins_;
};

/// The result of one batch, or the sum of several.
struct BatchResult {
  std::size_t batches = 0;           ///< How many.
  std::size_t steps = 0;             ///< Of the engine.
  std::size_t reached = 0;           ///< Those that reached their target.
  std::size_t violations = 0;        ///< Of the audits.
  std::size_t audits_cut = 0;        ///< Audits that took too long, and do not count as passed.
  std::size_t straight_motions = 0;  ///< Free straight motions that the engine was asked to make at the end.
  std::size_t stuck = 0;             ///< Those of which it made less than nine tenths.
  std::size_t front = 0;             ///< Most pairs of nodes.
  double longest_us = 0;             ///< The longest step.
  TimeHistogram times;               ///< Of the steps.
  double engine_seconds = 0;         ///< Wall time of building the engine and of the steps.
  double audit_seconds = 0;          ///< Wall time of the audits, and of the tests for being stuck.
  std::string message;               ///< The first violation.
  /// True if nothing is wrong.
  bool good() const { return violations == 0 && stuck == 0; }
  /// Adds the result of other batches.
  void add(const BatchResult& other);
};

/// A batch, and what reproduces it.
struct Batch {
  BatchResult result;
  Motion motion;
  Path path;
};

/// Starts in the assembled state and drags random components one after another, in random directions, by a trembling
/// hand that ignores obstacles; audits the path. Then the last component is tested for being stuck: where the audit
/// finds a short straight motion free with six tenths of the tolerance for all pairs, the engine must make nine tenths
/// of it. Depends on the arguments alone, apart from times. @param surfaces, auditor of the assembly
Batch run_batch(const Assembly& assembly, const PairStates& states, std::shared_ptr<const AssemblySurfaces> surfaces,
                const PathAuditor& auditor, std::uint64_t seed, const BatchOptions& options);

}  // namespace dismantle::soak
