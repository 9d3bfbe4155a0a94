// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/blocking_table.h"
#include "dismantle/planner/plan.h"

#include <optional>

namespace dismantle {

/// Searches for overlaps by which components stay where they are.
class OverlapSearch {
 public:
  /// @param states the pairs in the assembled state @param table of all components; both must outlive this
  OverlapSearch(const Assembly& assembly, const PairStates& states, BlockingTable& table,
                const CertificateOptions& options)
      : assembly_(assembly), states_(states), table_(table), options_(options) {
    options_.prepared = nullptr;  // shapes that are shared would keep what is found for each depth that is tried
  }

  /// The straight way out of `present` along one of `directions` for which pairs of a component and its group would
  /// have to be allowed the least depth, to within a tenth, that is no more than `most` above what they are allowed;
  /// nothing where there is no such way, or what blocks is apart from it in the assembled state: an allowance ends
  /// where two components have been apart. What is tested is the certified motion of each pair.
  /// @pre it is blocked along all of them
  std::optional<LeastOverlap> find(ComponentId component, Span<const DirectionId> directions,
                                   const ComponentSet& present, double most, const KeepGoing& keep_going) const;

 private:
  std::optional<NeededOverlap> needed(ComponentId moving, DirectionId d, ComponentId fixed, double most,
                                      const KeepGoing& keep_going) const;

  const Assembly& assembly_;
  const PairStates& states_;
  BlockingTable& table_;
  CertificateOptions options_;
};

}  // namespace dismantle
