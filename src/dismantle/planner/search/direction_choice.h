// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/planned_assembly.h"
#include "dismantle/planner/search/candidate_directions.h"
#include "dismantle/planner/search/removal_search.h"

#include <vector>

namespace dismantle {

/// The directions that a planner tries for each component: first those that move it away from all that it touches, then
/// those that many components share (fewer turns of the assembly), then the rest of its own.
class DirectionChoice {
 public:
  /// Adds the directions to `table`, and tells it which neighbours to test first.
  /// @param staying components that never move: they get only shared directions
  /// @param engine with all components in their assembled poses
  /// @param keep_going thread-safe; components after it returns false get only shared directions
  DirectionChoice(const PlannedAssembly& planned, BlockingTable& table, const CertificateEngine& engine,
                  const ComponentSet& staying, const Executor& executor, const KeepGoing& keep_going);
  DirectionChoice(const DirectionChoice&) = delete;
  DirectionChoice& operator=(const DirectionChoice&) = delete;

  /// The directions of each component, the most promising first. Shape [component_count].
  const DirectionLists& directions() const { return directions_; }
  /// Makes a unit direction the first one of a component.
  void put_first(ComponentId c, const Vec3& direction);
  /// The contact normals of a component in its assembled pose; empty for one of `staying`.
  const ContactNormals& contacts(ComponentId c) const { return contacts_[c.value]; }

 private:
  std::vector<DirectionId> in_order(const std::vector<CandidateDirection>& own, const std::vector<DirectionId>& shared);
  DirectionId one_along(const std::vector<DirectionId>& list, DirectionId d) const;
  std::vector<DirectionId> most_popular(const std::vector<double>& popularity) const;

  BlockingTable& table_;
  std::vector<ContactNormals> contacts_;
  DirectionLists directions_;
};

}  // namespace dismantle
