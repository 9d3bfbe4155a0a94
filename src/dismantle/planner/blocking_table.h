// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/bvh/sphere_tree.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/keep_going.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/joint_relations.h"
#include "dismantle/planner/shape_features.h"

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

using DirectionId = Id<struct DirectionTag>;  ///< Index of a direction within a BlockingTable.

/// Directional blocking relations (Wilson, Latombe 1994): which component blocks which on a straight motion to infinity
/// from the assembled state. A relation is computed on first use and does not depend on what else is removed.
/// Certified: a component that does not block is free of contact over the true motion. Only components whose bounds
/// meet the volume that a motion sweeps are stored and swept.
class BlockingTable {
 public:
  /// @param engine, features (of every component), groups must outlive the table
  /// @param keep_going once it returns false, nothing is computed any more: unknown relations then count as
  /// blocked, without being stored
  BlockingTable(const CertificateEngine& engine, Span<const ShapeFeatures> features, const RigidGroups& groups,
                KeepGoing keep_going);

  /// Registers a unit direction; directions within 1e-6 of each other share an id.
  DirectionId add_direction(const Vec3& unit);
  /// The unit vector of a direction.
  const Vec3& direction(DirectionId d) const { return directions_[d.value]; }
  /// The opposite direction.
  DirectionId opposite(DirectionId d) { return add_direction(-directions_[d.value]); }
  /// Distance along `d` after which `moving` has passed everything that is in its assembled pose [mm].
  double exit_distance(ComponentId moving, DirectionId d) const;

  /// Distance in any direction after which the group of `moving` has passed everything that is in its assembled pose
  /// [mm].
  double max_exit_distance(ComponentId moving) const;
  /// Centre of the bounding sphere of an assembled component [mm].
  Vec3 center(ComponentId c) const { return features_[c.value].center; }
  /// Radius of that sphere [mm].
  double radius(ComponentId c) const { return features_[c.value].radius; }

  /// The groups of components that move together.
  const RigidGroups& groups() const { return groups_; }
  /// The largest component of the group of a component, for which the whole group is searched for and explained.
  ComponentId leader_of(ComponentId c) const;

  /// True if `fixed` blocks `moving` along `d`; components of one group always do.
  bool blocks(ComponentId moving, DirectionId d, ComponentId fixed);
  /// The components whose bounds meet the volume that `moving` sweeps along `d`, ascending: no others block it.
  const std::vector<ComponentId>& near(ComponentId moving, DirectionId d) { return row(moving, d).near; }
  /// A blocking component among `present`, if there is one; the same one as long as it is present.
  std::optional<ComponentId> any_blocker(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// The blocking components among `present`, ascending; at most `enough` of them. May be called at the same time for
  /// different directions or components.
  std::vector<ComponentId> blockers(ComponentId moving, DirectionId d, const ComponentSet& present,
                                    std::size_t enough = std::numeric_limits<std::size_t>::max());
  /// The smallest subset of `present` that can move along `d` as one body with `moving`: itself, its blockers, theirs,
  /// ...
  std::vector<ComponentId> moving_together(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// Working memory of moving_together(). Calls that do not overlap in time may share it.
  struct Together {
    ComponentSet set;                     ///< The components that move together, as far as they are known.
    std::vector<ComponentId> members;     ///< Of `set`.
    std::vector<ComponentId> blocked_by;  ///< Of each component in `set`: the one that it moves along with.
    /// @param count of components in the assembly
    explicit Together(std::size_t count) : set(count), blocked_by(count) {}
  };
  /// As above, but empty as soon as the subset would contain one of `ends` or more than `most()` components, which may
  /// decrease meanwhile. Components that fail for that reason are added to `ends`: with the same `present`, `d` and no
  /// larger `most` they need not be expanded again. May be called at the same time for different directions,
  /// each with its own memory.
  std::vector<ComponentId> moving_together(ComponentId moving, DirectionId d, const ComponentSet& present,
                                           ComponentSet& ends, const std::function<std::size_t()>& most,
                                           Together& memory);
  /// While postponed, relations that are hard to decide, where depths have to be bounded, count as blocking.
  void postpone_hard(bool postpone) { postpone_ = postpone; }
  /// True if `fixed` counts as blocking because that is postponed.
  bool is_postponed(ComponentId moving, DirectionId d, ComponentId fixed);
  /// Predicts the components that probably block a component along a unit direction; they are tested first.
  using Expectation = std::function<std::vector<ComponentId>(ComponentId moving, const Vec3& direction)>;
  /// Sets the prediction. @pre no relation was computed yet
  void expect_blockers(Expectation expectation) { expectation_ = std::move(expectation); }
  /// One of `present` that is known or predicted to block, if there is one.
  std::optional<ComponentId> expected_blocker(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// Lets two components pass each other along an axis only, either way: a ring that gives, and what it is on.
  /// @pre no relation of the two was computed yet
  void let_pass_along(ComponentId a, ComponentId b, Vec3 axis);
  /// Has joints block as well, until it is called again: fasteners what they hold, and components of one joint move as
  /// one body. Contacts do not know of it.
  /// @param joints null for collisions only; must outlive its use
  void follow(const JointRelations* joints) { joints_ = joints; }
  /// Records that `fixed` blocks, by a rule that a single sweep does not test.
  void add_blocker(ComponentId moving, DirectionId d, ComponentId fixed);
  /// A contact with a blocking component, the first one or not much later (StraightSearch::Near); none if it does not
  /// block, or the search ended.
  std::optional<StraightContact> contact(ComponentId moving, DirectionId d, ComponentId fixed) const;

 private:
  enum class Known : std::uint8_t {
    Nothing,
    Hard,  // not decided by a quick search
    Free,
    Blocks,
  };
  /// The relations of a component along a direction. Components that are not in it do not block.
  struct Row {
    std::vector<ComponentId> near;       ///< Ascending.
    std::vector<Known> known;            ///< Of each of these.
    std::vector<std::uint32_t> nearest;  ///< Their indices, the nearest first.
    ComponentId witness;                 ///< The last one found to block.
    std::vector<ComponentId> expected;

    /// The relation to a component; null if that is not near.
    Known* find(ComponentId c);
  };
  Row& row(ComponentId moving, DirectionId d);
  Row new_row(ComponentId moving, DirectionId d) const;
  bool blocks(Row& row, ComponentId moving, DirectionId d, ComponentId fixed);
  Known decide(ComponentId moving, DirectionId d, ComponentId fixed) const;
  /// A component of `present` outside `together` that blocks `moving`, if there is one. Tries the expected blockers
  /// first, then those in `ends`.
  std::optional<ComponentId> another_blocker(ComponentId moving, DirectionId d, const ComponentSet& present,
                                             const ComponentSet& together, const ComponentSet& ends);
  /// Calls visit(component, way_past) for those with a way past them.
  template <class Visit>
  void for_each_in_way(ComponentId moving, DirectionId d, const Visit& visit) const;
  /// Distance along `d` after which `moving` has passed `fixed` [mm]; 0 if it never comes near it.
  double way_past(ComponentId moving, DirectionId d, ComponentId fixed) const;
  /// True if the bounding boxes certainly stay apart, also when projected along `d`.
  bool boxes_stay_apart(ComponentId moving, DirectionId d, ComponentId fixed) const;
  /// False if the two may pass each other along an axis only, and this is another direction.
  bool may_pass(ComponentId moving, DirectionId d, ComponentId fixed) const;
  bool passes_along_axis(ComponentId a, ComponentId b) const { return only_along_.count(std::minmax(a, b)) > 0; }
  void remember_blocker(ComponentId moving, ComponentId blocker);
  /// The component to which a joint still holds `moving`; none unless the plan respects joints.
  std::optional<ComponentId> joint_blocker(ComponentId moving, DirectionId d, const ComponentSet& present) const;

  const CertificateEngine& engine_;
  Span<const ShapeFeatures> features_;
  const RigidGroups& groups_;
  KeepGoing keep_going_;
  const JointRelations* joints_ = nullptr;
  bool postpone_ = false;
  Expectation expectation_;
  std::vector<Vec3> directions_;
  std::map<std::array<std::int64_t, 3>, std::vector<DirectionId>> cells_;  // of directions, for those that are equal
  std::map<std::pair<ComponentId, ComponentId>, Vec3> only_along_;         // a < b
  SphereTree spheres_;                                                     // of all components
  std::vector<std::map<DirectionId, Row>> rows_;         // of every component: several may be asked side by side
  std::vector<std::mutex> row_mutexes_;                  // of every component: held while a row is made
  std::vector<std::vector<ComponentId>> last_blockers_;  // of every component, in any direction; the last first
};

}  // namespace dismantle
