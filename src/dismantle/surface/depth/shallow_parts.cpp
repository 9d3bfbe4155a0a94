// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/shallow_parts.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Parts of a surface: all are forgotten above this number (10 MB).
constexpr std::size_t kMost = 100000;
/// Faces of fewer parts are not divided anew; what is tried must leave less than half of them.
constexpr std::size_t kFewParts = 16;
/// A face is tried again after this many times at the latest.
constexpr unsigned kLongestWait = 64;

}  // namespace

std::vector<ShallowPart>* ShallowParts::of(std::uint32_t face) {
  const auto found = faces_.find(face);
  return found == faces_.end() ? nullptr : &found->second.parts;
}

void ShallowParts::set(std::uint32_t face, std::vector<ShallowPart> parts) {
  const auto found = faces_.find(face);
  if (found != faces_.end()) {
    count_ -= found->second.parts.size();
    faces_.erase(found);
  }
  if (parts.empty()) return;
  if (count_ + parts.size() > kMost) clear();
  count_ += parts.size();
  faces_[face] = {std::move(parts)};
}

void ShallowParts::refine(std::uint32_t face, std::vector<ShallowPart> parts) {
  Entry& entry = faces_.at(face);
  count_ += parts.size() - entry.parts.size();
  entry.parts = std::move(parts);
}

std::size_t ShallowParts::due(std::uint32_t face) {
  const auto found = faces_.find(face);
  if (found == faces_.end() || found->second.parts.size() < kFewParts) return 0;
  Entry& entry = found->second;
  if (++entry.waited < entry.wait) return 0;
  entry.waited = 0;
  entry.wait = std::min(2 * entry.wait, kLongestWait);
  return entry.parts.size() / 2;
}

void ShallowParts::clear() {
  faces_.clear();
  count_ = 0;
}

}  // namespace dismantle
