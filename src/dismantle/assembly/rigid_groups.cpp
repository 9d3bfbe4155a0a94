// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/rigid_groups.h"

#include <fnmatch.h>

#include <algorithm>
#include <numeric>

namespace dismantle {

namespace {

bool fits(const std::string& pattern, const std::string& name) {
  return pattern == name || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

}  // namespace

std::vector<std::vector<ComponentId>> components_below(const Assembly& assembly) {
  std::vector<std::vector<ComponentId>> below(assembly.tree.size());
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    for (std::uint32_t node = assembly.components[c].tree_node; node < below.size();) {
      below[node].emplace_back(c);
      if (assembly.tree[node].parent == node) break;
      node = assembly.tree[node].parent;
    }
  return below;
}

std::vector<ComponentId> components_named(const Assembly& assembly, const std::string& pattern) {
  std::vector<ComponentId> fitting;
  for (std::uint32_t c = 0; c < assembly.components.size(); ++c)
    if (fits(pattern, assembly.components[c].name)) fitting.emplace_back(c);
  return fitting;
}

RigidGroups::RigidGroups(std::size_t count) : group_(count), members_(count) {
  std::iota(group_.begin(), group_.end(), std::size_t{0});
  for (std::uint32_t c = 0; c < count; ++c) members_[c] = {ComponentId(c)};
}

void RigidGroups::unite(Span<const ComponentId> components) {
  if (components.empty()) return;
  const std::size_t into = group_[components[0].value];
  for (const ComponentId c : components) {
    const std::size_t from = group_[c.value];
    if (from == into) continue;
    for (const ComponentId member : members_[from]) {
      group_[member.value] = into;
      members_[into].push_back(member);
    }
    members_[from].clear();
  }
  std::sort(members_[into].begin(), members_[into].end());
}

std::vector<ComponentId> RigidGroups::with_groups(Span<const ComponentId> components) const {
  std::vector<ComponentId> all;
  for (const ComponentId c : components) all.insert(all.end(), of(c).begin(), of(c).end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::vector<ComponentId>> RigidGroups::of_several() const {
  std::vector<std::vector<ComponentId>> groups;
  std::copy_if(members_.begin(), members_.end(), std::back_inserter(groups),
               [](const auto& members) { return members.size() > 1; });
  return groups;
}

Result<RigidGroups> named_groups(const Assembly& assembly, Span<const std::string> patterns) {
  RigidGroups groups(assembly.components.size());
  if (patterns.empty()) return groups;
  const std::vector<std::vector<ComponentId>> below = components_below(assembly);
  for (const std::string& pattern : patterns) {
    bool found = false;
    for (std::size_t node = 1; node < below.size(); ++node)  // not the root
      if (below[node].size() > 1 && fits(pattern, assembly.tree[node].name)) {
        groups.unite(below[node]);
        found = true;
      }
    if (found) continue;
    const std::vector<ComponentId> fitting = components_named(assembly, pattern);
    if (fitting.empty())
      return Error{ErrorKind::Usage, "'" + pattern +
                                         "' is unknown (no sub-assembly and no component has such a name); "
                                         "'dismantle info' lists them"};
    if (fitting.size() == 1)
      return Error{ErrorKind::Usage, "'" + pattern + "' cannot be treated as one part (it is one component, '" +
                                         assembly[fitting[0]].name + "'); name a sub-assembly or several components"};
    groups.unite(fitting);
  }
  return groups;
}

}  // namespace dismantle
