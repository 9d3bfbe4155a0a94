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

constexpr double kFiner = 8;  // a mesh of a tenth of the deflection has about that many more triangles

constexpr Budget kCad{768 * kMega, 100, 60, 15, 300};
constexpr Budget kMesh{512 * kMega, 100, 60, 5, 120};

}  // namespace

IsolationLimits import_budget(const FormatEntry* entry, std::uint64_t bytes, const ImportOptions& options) {
  const ImportLimits& limits = options.limits;
  const bool is_finer = options.deflection > 0 || options.angular_deflection > 0;
  const double more = is_finer ? kFiner : 1;
  const Budget& budget = entry != nullptr && entry->by_cad_kernel ? kCad : kMesh;
  IsolationLimits result;
  result.memory_bytes = static_cast<std::uint64_t>(more) * (budget.memory_base + budget.memory_per_byte * bytes);
  result.cpu_seconds = more * (budget.seconds_base + budget.seconds_per_mega * static_cast<double>(bytes) / kMega);
  result.silence_seconds = budget.silence;
  if (limits.memory_bytes > 0) result.memory_bytes = limits.memory_bytes;
  if (limits.cpu_seconds > 0) {
    result.cpu_seconds = limits.cpu_seconds;
    result.silence_seconds = limits.cpu_seconds;
  }
  return result;
}

}  // namespace dismantle
