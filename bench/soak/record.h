// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/soak/batch.h"
#include "dismantle/core/result.h"

#include <fstream>
#include <mutex>
#include <set>

namespace dismantle::soak {

/// The results of the batches that were run, in a file of JSON lines that grows: a soak that was ended goes on from it.
/// A last line that was not finished is left out. Opening it sums up what it has of each assembly in one line.
class Record {
 public:
  /// Opens or makes the file. @param file empty: kept in memory only
  /// Errors: Failed where it cannot be read or written, or belongs to other settings.
  static Result<Record> open(const std::string& file, std::uint64_t seed, int targets);
  Record(Record&& other) noexcept;

  /// True if a batch is recorded.
  bool has(const std::string& assembly, std::uint64_t batch) const;
  /// Adds a batch, and writes it at once. Several threads may add. Errors: Failed where it cannot be written.
  Result<Done> add(const std::string& assembly, std::uint64_t batch, const BatchResult& result);
  /// The sum of the batches of an assembly.
  BatchResult of(const std::string& assembly) const;

 private:
  struct Entry {
    std::set<std::uint64_t> done;
    BatchResult sum;
  };

  Record() = default;
  Result<Done> read(const std::string& settings);
  Result<Done> rewrite(const std::string& settings);

  std::string file_;
  std::ofstream out_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace dismantle::soak
