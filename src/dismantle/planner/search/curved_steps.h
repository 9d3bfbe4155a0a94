// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/planner/plan.h"
#include "dismantle/planner/search/component_axes.h"
#include "dismantle/planner/search/long_searches.h"
#include "dismantle/planner/search/screw_search.h"

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dismantle {

/// Inputs of the searches for curved steps; all must outlive them.
struct CurvedSearch {
  const RigidGroups& groups;           ///< Components that move together.
  Span<const ShapeFeatures> features;  ///< Of each component.
  MotionValidator& validator;          ///< Validates motions.
  BlockingTable& table;                ///< Blocking relations.
  const DirectionChoice& choice;       ///< Directions of each component.
  const KeepGoing& keep_going;         ///< Once it returns false, nothing is found any more.
};

/// Finds steps of one component, with its group, that are not straight. What was tried in vain is remembered.
class CurvedSteps {
 public:
  /// Which components a search for threads considers.
  enum class Groups {
    Single,     ///< Those that move by themselves.
    OfSeveral,  ///< Those that move with others.
  };

  /// @param slide_effort, sample_effort PlanOptions
  CurvedSteps(const PlannedAssembly& planned, const CurvedSearch& search, std::size_t slide_effort,
              std::size_t sample_effort);

  /// A step that unscrews one component, the smallest first. @param joints those that hold it are respected; may be
  /// null
  std::optional<PlanStep> find_screwed(const ComponentSet& body, const ComponentSet& staying, Groups groups,
                                       const JointRelations* joints);
  /// A step that slides along contacts.
  std::optional<PlanStep> find_sliding(const ComponentSet& body, const ComponentSet& staying);
  /// A step by random sampling. @pre find_sliding() found none
  std::optional<PlanStep> find_sampled(const ComponentSet& body, const ComponentSet& staying);
  /// True if no sliding or sampled path was found for one of these, with its group, for want of effort.
  bool may_find_more(Span<const Explanation> staying) const;

 private:
  template <class Search>
  std::optional<PlanStep> find_long(LongSearches& searches, const ComponentSet& body, const ComponentSet& staying,
                                    const Search& search);
  bool holds(ComponentId c, const NeighbourThread& thread);
  PlanStep with_group(PlanStep step) const;
  std::vector<ComponentId> smallest_first(const ComponentSet& body, const ComponentSet& staying) const;

  CurvedSearch with_;
  ComponentAxes axes_;
  LongSearches sliding_, sampling_;
  std::map<std::pair<ComponentId, ComponentId>, std::vector<ComponentId>> met_;  // by pairs that could not be unscrewed
  std::set<std::pair<ComponentId, ComponentId>> overlapping_;                    // a < b
  std::map<const NeighbourThread*, bool> held_;                                  // see holds()
};

}  // namespace dismantle
