// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/shallow_parts.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// Most parts that are kept of a surface (10 MB); if there are more, all are forgotten.
constexpr std::size_t kMost = 100000;
/// A face with fewer parts is not subdivided again. A new subdivision is kept if it has less than half as many parts.
constexpr std::size_t kFewParts = 16;
/// Most motions between two attempts to subdivide a face again.
constexpr unsigned kLongestWait = 64;

}  // namespace

bool ShallowParts::begin(const RigidTransform& start, const RigidTransform& end) {
  if (motion_ > 0 && start == start_ && end == end_) return true;
  start_ = start;
  end_ = end;
  ++motion_;
  ended_at.reset();
  return false;
}

const std::vector<ShallowPart>* ShallowParts::of(std::uint32_t face) const {
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
  entry.proved = 0;
  if (count_ > kMost) clear();
}

void ShallowParts::note_proved(std::uint32_t face, std::size_t first, double from, double to) {
  const auto found = faces_.find(face);
  if (found == faces_.end()) return;
  Entry& entry = found->second;
  entry.motion = motion_;
  entry.proved = first;
  entry.from = from;
  entry.to = to;
}

std::size_t ShallowParts::proved(std::uint32_t face, double from, double to) const {
  const Entry& entry = faces_.at(face);
  return entry.motion == motion_ && entry.from == from && entry.to == to ? entry.proved : 0;
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
  ended_at.reset();
  count_ = 0;
}

}  // namespace dismantle
