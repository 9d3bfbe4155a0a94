// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/import_budget.h"

namespace dismantle {

namespace {

constexpr std::uint64_t kMega = std::uint64_t{1} << 20;

/// A base, and a share for each byte of the file.
struct Budget {
  std::uint64_t memory_base, memory_per_byte;  // [bytes]
  double seconds_base, seconds_per_mega;       // [s]
  double silence;                              // [s]
};

constexpr Budget kCad{1024 * kMega, 400, 120, 60, 300};
constexpr Budget kMesh{512 * kMega, 100, 60, 5, 120};

}  // namespace

IsolationLimits import_budget(const FormatEntry* entry, std::uint64_t bytes, const ImportLimits& limits) {
  const Budget& budget = entry != nullptr && entry->by_cad_kernel ? kCad : kMesh;
  IsolationLimits result;
  result.memory_bytes = budget.memory_base + budget.memory_per_byte * bytes;
  result.cpu_seconds = budget.seconds_base + budget.seconds_per_mega * static_cast<double>(bytes) / kMega;
  result.silence_seconds = budget.silence;
  if (limits.memory_bytes > 0) result.memory_bytes = limits.memory_bytes;
  if (limits.cpu_seconds > 0) {
    result.cpu_seconds = limits.cpu_seconds;
    result.silence_seconds = limits.cpu_seconds;
  }
  return result;
}

}  // namespace dismantle
