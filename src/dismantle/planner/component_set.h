// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// A subset of the components of an assembly.
class ComponentSet {
 public:
  /// The empty subset of `count` components.
  explicit ComponentSet(std::size_t count) : has_(count) {}
  /// These members of `count` components.
  ComponentSet(std::size_t count, Span<const ComponentId> members) : has_(count) {
    for (const ComponentId c : members) insert(c);
  }
  /// All of `count` components.
  static ComponentSet all(std::size_t count) {
    ComponentSet set(count);
    for (std::uint32_t c = 0; c < count; ++c) set.insert(ComponentId(c));
    return set;
  }

  /// True if `c` is a member.
  bool has(ComponentId c) const { return has_[c.value] != 0; }
  /// True if any of `components` is a member.
  bool has_any(Span<const ComponentId> components) const {
    for (const ComponentId c : components)
      if (has(c)) return true;
    return false;
  }
  /// True if all of `components` are members.
  bool has_all(Span<const ComponentId> components) const {
    for (const ComponentId c : components)
      if (!has(c)) return false;
    return true;
  }
  /// Adds a member.
  void insert(ComponentId c) {
    size_ += has_[c.value] == 0;
    has_[c.value] = 1;
  }
  /// Removes a member.
  void erase(ComponentId c) {
    size_ -= has_[c.value];
    has_[c.value] = 0;
  }
  /// Removes members.
  void erase(Span<const ComponentId> components) {
    for (const ComponentId c : components) erase(c);
  }
  /// Number of members.
  std::size_t size() const { return size_; }
  /// Number of components of the assembly.
  std::size_t universe() const { return has_.size(); }
  /// The members in ascending order.
  std::vector<ComponentId> members() const {
    std::vector<ComponentId> members;
    for (std::uint32_t c = 0; c < has_.size(); ++c)
      if (has_[c] != 0) members.emplace_back(c);
    return members;
  }
  friend bool operator==(const ComponentSet&, const ComponentSet&) = default;

 private:
  std::vector<std::uint8_t> has_;
  std::size_t size_ = 0;
};

}  // namespace dismantle
