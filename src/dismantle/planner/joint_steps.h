// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/joint_relations.h"
#include "dismantle/planner/search/direction_choice.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Straight removals in the order in which a person undoes joints.
class JointSteps {
 public:
  /// All must outlive this. @param table follows `relations` whenever this is used
  JointSteps(const JointRelations& relations, BlockingTable& table, const DirectionChoice& choice,
             const RigidGroups& groups)
      : relations_(relations), table_(table), choice_(choice), groups_(groups) {}

  /// The first of some components, with its group, that can be removed straight; along `last`, if possible.
  std::optional<StraightRemoval> first_free(const std::vector<ComponentId>& components, DirectionId last,
                                            const ComponentSet& present, const ComponentSet& staying);
  /// The removal of a fastener with those of its washers that can move along; any other removal as it is.
  StraightRemoval with_washers(StraightRemoval removal, const ComponentSet& present, const ComponentSet& staying);

 private:
  const JointRelations& relations_;
  BlockingTable& table_;
  const DirectionChoice& choice_;
  const RigidGroups& groups_;
};

}  // namespace dismantle
