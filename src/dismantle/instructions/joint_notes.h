// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/fastener.h"
#include "dismantle/instructions/motion_text.h"
#include "dismantle/planner/joint_relations.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// Notes on the joints (find_joints()) that steps of work instructions release or leave holding.
class JointNotes {
 public:
  /// @param fasteners find_fasteners()
  JointNotes(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners, const Executor& executor);

  /// The component that a tool turns for a removal: the only one, or the fastener of a set of it and its washers;
  /// invalid for other sets.
  ComponentId turned_in(const RemovalMove& removal) const;
  /// True for a screw or nut that was screwed into or onto something.
  bool is_of_joint(ComponentId c) const { return relations_.is_fastener(c); }
  /// How a removal unscrews a fastener along its first leg; nothing if that turns, or no thread is in.
  /// @param leg the first one of the removal
  std::optional<Unscrewing> unscrewing(const WorkStep& step, const RemovalMove& removal, const Leg& leg) const;
  /// The fasteners that still hold what a removal moves: JointRelations::torn_by().
  /// @param leg the first one of the removal
  std::vector<ComponentId> still_held_by(const WorkStep& step, const RemovalMove& removal, const Leg& leg) const;

 private:
  const std::vector<Joint> joints_;
  RigidGroups groups_;
  JointRelations relations_;
};

}  // namespace dismantle
