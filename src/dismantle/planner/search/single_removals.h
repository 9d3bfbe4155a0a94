// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/joint_steps.h"
#include "dismantle/planner/order/step_order.h"
#include "dismantle/planner/plan_disassembly.h"
#include "dismantle/planner/search/exposure.h"
#include "dismantle/planner/search/free_component_search.h"

#include <vector>

namespace dismantle {

/// Inputs of SingleRemovals; all must outlive it.
struct SingleRemovalSearch {
  const Assembly& assembly;                    ///< What is planned.
  const std::vector<ShapeFeatures>& features;  ///< Of each component.
  const JointRelations& relations;             ///< Of all joints.
  BlockingTable& table;                        ///< Blocking relations.
  const DirectionChoice& choice;               ///< Directions of each component.
  JointSteps& joint_steps;                     ///< Removals in the order in which joints are undone.
  const PlanOptions& options;                  ///< preferences, and the executor of the engine.
  const KeepGoing& keep_going;                 ///< Once it returns false, nothing is found any more; thread-safe.
};

/// Searches for single components of one body.
struct BodySearches {
  FreeComponentSearch by_joints;      ///< While the table follows joints.
  FreeComponentSearch by_collisions;  ///< While it does not.
  /// Tests those again that were blocked by relations that were postponed.
  void retry_postponed() {
    by_joints.retry_postponed();
    by_collisions.retry_postponed();
  }
  /// Notes that components are not there any more.
  void remove(Span<const ComponentId> components) {
    by_joints.remove(components);
    by_collisions.remove(components);
  }
};

/// Chooses among the single components that can be removed straight next: fasteners and what lies open come before what
/// others enclose. Parts leave along the free direction that costs least after the step before, fasteners along their
/// axes.
class SingleRemovals {
 public:
  /// The components that are considered.
  enum class Among {
    Reachable,  ///< Fasteners, and components that are exposed (Exposure).
    All,        ///< All components.
  };

  /// Nothing is searched yet.
  explicit SingleRemovals(const SingleRemovalSearch& search);

  /// Searches in a body, from the beginning.
  BodySearches searches_in(const ComponentSet& body, const ComponentSet& staying) const;

  /// The steps before the one that is sought.
  struct Before {
    const PlanStep* step = nullptr;  ///< The previous step; null for none.
    DirectionId direction;           ///< Of the last straight step; invalid for none.
  };
  /// Components that can be removed from `body`, in the order in which to try them; empty only if there is none, or the
  /// search was ended.
  /// @param searches of this body @param joints the table follows; null for none
  std::vector<StraightRemoval> find(const ComponentSet& body, const ComponentSet& staying, BodySearches& searches,
                                    const JointRelations* joints, Among among, const Before& before);

 private:
  const std::vector<ComponentId>& kinds();
  /// The cost of a step along a direction, by the weights of `direction` and `upright`.
  double cost(DirectionId d, const Before& before) const;
  /// Takes another free direction of a removal that costs less, if there is one.
  void choose_direction(StraightRemoval& removal, const ComponentSet& body, const Before& before);

  SingleRemovalSearch with_;
  OrderWeights weights_;
  ComponentSet fasteners_;  // of joints
  Exposure exposure_;
  std::vector<ComponentId> kinds_;  // first_of_shape(), once it is needed
};

}  // namespace dismantle
