// SPDX-License-Identifier: Apache-2.0
#include "dismantle/exec/radix_sort.h"

#include <algorithm>

namespace dismantle {

namespace {

constexpr int kDigitBits = 11;
constexpr std::size_t kDigitValues = std::size_t{1} << kDigitBits;
constexpr int kDigitCount = (64 + kDigitBits - 1) / kDigitBits;
constexpr std::size_t kFewKeys = 1024;  // below, std::sort is as fast

std::size_t digit(std::uint64_t key, int index) {
  return static_cast<std::size_t>(key >> (index * kDigitBits)) & (kDigitValues - 1);
}

}  // namespace

void radix_sort(Span<std::uint64_t> keys, std::vector<std::uint64_t>& scratch) {
  if (keys.size() < kFewKeys) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  if (scratch.size() < keys.size()) scratch.resize(keys.size());
  std::uint64_t varying = 0;
  for (const std::uint64_t key : keys) varying |= key ^ keys[0];

  std::uint64_t* from = keys.data();
  std::uint64_t* to = scratch.data();
  for (int index = 0; index < kDigitCount; ++index) {
    if (digit(varying, index) == 0) continue;
    std::size_t position[kDigitValues] = {};
    for (std::size_t i = 0; i < keys.size(); ++i) ++position[digit(from[i], index)];
    std::size_t begin = 0;
    for (std::size_t& p : position) {
      const std::size_t count = p;
      p = begin;
      begin += count;
    }
    for (std::size_t i = 0; i < keys.size(); ++i) to[position[digit(from[i], index)]++] = from[i];
    std::swap(from, to);
  }
  if (from != keys.data()) std::copy(from, from + keys.size(), keys.data());
}

}  // namespace dismantle
