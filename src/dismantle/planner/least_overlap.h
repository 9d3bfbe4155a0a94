// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/plan.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// Searches for overlaps by which components stay where they are.
class OverlapSearch {
 public:
  /// @param states the pairs in the assembled state @param table of all components; both must outlive this
  OverlapSearch(const Assembly& assembly, const PairStates& states, BlockingTable& table,
                const CertificateOptions& options)
      : assembly_(assembly), states_(states), table_(table), options_(options) {
    options_.prepared = nullptr;  // shapes keep what is found for each depth that is tried: no longer than find()
    options_.executor = {};       // components are searched side by side
  }

  /// A direction in which few components block one that is left.
  struct Way {
    DirectionId direction;                                     ///< Its direction.
    std::vector<std::pair<ComponentId, ComponentId>> blocked;  ///< One that moves, and what blocks it.
  };
  /// The ways out of `present` for a component and its group along some of `directions`, those with the fewest blockers
  /// first. @pre it is blocked along all of them
  std::vector<Way> ways_out(ComponentId component, Span<const DirectionId> directions, const ComponentSet& present);
  /// The one of some ways out for which pairs would have to be allowed the least depth, to within a tenth, that is no
  /// more than `most` above what they are allowed; nothing where there is no such way, or what blocks is apart from it
  /// in the assembled state: an allowance ends where two components have been apart. What is tested is the certified
  /// motion of each pair. May be called by many threads at the same time.
  std::optional<LeastOverlap> find(const std::vector<Way>& ways, double most, const KeepGoing& keep_going) const;

 private:
  /// @param prepared the surfaces of the pair; null before the first search
  std::optional<NeededOverlap> needed(ComponentId moving, DirectionId d, ComponentId fixed, double most,
                                      const KeepGoing& keep_going,
                                      std::shared_ptr<const AssemblySurfaces>& prepared) const;

  const Assembly& assembly_;
  const PairStates& states_;
  BlockingTable& table_;
  CertificateOptions options_;
};

}  // namespace dismantle
