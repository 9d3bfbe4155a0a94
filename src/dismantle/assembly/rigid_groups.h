// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/core/span.h"

#include <string>
#include <vector>

namespace dismantle {

/// The components of an assembly in groups that are not taken apart: bearings, motors, sub-assemblies. Each component
/// is in one group, most of them in one of their own.
class RigidGroups {
 public:
  /// @param count of components, each in a group of its own
  explicit RigidGroups(std::size_t count);

  /// Makes one group of the groups of some components.
  void unite(Span<const ComponentId> components);

  /// The group of a component, ascending.
  Span<const ComponentId> of(ComponentId c) const { return members_[group_[c.value]]; }
  /// True if two components are in one group.
  bool together(ComponentId a, ComponentId b) const { return group_[a.value] == group_[b.value]; }
  /// Components and all that are in a group with one of them, ascending.
  std::vector<ComponentId> with_groups(Span<const ComponentId> components) const;
  /// The groups of more than one component.
  std::vector<std::vector<ComponentId>> of_several() const;

 private:
  std::vector<std::size_t> group_;                 // of each component
  std::vector<std::vector<ComponentId>> members_;  // of each group; empty for those that became part of another
};

/// The components below each node of the product tree, ascending.
std::vector<std::vector<ComponentId>> components_below(const Assembly& assembly);

/// The components of a name, or of a pattern with * and ?, ascending.
std::vector<ComponentId> components_named(const Assembly& assembly, const std::string& pattern);

/// The groups that a user names. A name, or a pattern with * and ?, is that of sub-assemblies of the product tree, each
/// of which becomes a group; where there is none, of components, which all together become one. Errors: Usage where
/// a name fits nothing, or only one component.
Result<RigidGroups> named_groups(const Assembly& assembly, Span<const std::string> patterns);

}  // namespace dismantle
