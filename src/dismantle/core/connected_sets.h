// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dismantle {

/// Elements 0, 1, ... in disjoint sets that are joined one by one (union-find).
class ConnectedSets {
 public:
  /// Each element is a set of its own.
  explicit ConnectedSets(std::size_t count = 0) { grow(count); }

  /// Number of elements.
  std::size_t size() const { return parent_.size(); }
  /// Adds elements until there are so many, each a set of its own. @pre not fewer than now
  void grow(std::size_t count) {
    const std::size_t first = parent_.size();
    parent_.resize(count);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(first), parent_.end(), static_cast<std::uint32_t>(first));
  }
  /// The element that represents the set of an element.
  std::uint32_t set_of(std::uint32_t element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }
  /// Joins the sets of two elements; that of `a` represents both.
  void join(std::uint32_t a, std::uint32_t b) { parent_[set_of(b)] = set_of(a); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace dismantle
