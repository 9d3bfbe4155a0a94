// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/classify_pairs.h"

#include "dismantle/surface/find_clashes.h"

#include <limits>

namespace dismantle {

PairStates pair_states(const Clashes& clashes, ClassifyRule rule) {
  PairStates states;
  states.tolerance = clashes.tolerance;
  for (const Clash& clash : clashes.pairs) {
    ComponentPair pair{clash.a, clash.b, PairState::Near, clash.distance, clash.depth, clashes.tolerance};
    if (clash.state == ClashState::Contact) pair.state = PairState::Contact;
    if (clash.state == ClashState::Overlapping) {
      pair.state = PairState::Overlapping;
      pair.allowed_depth = clash.depth + clashes.tolerance;
    }
    if (rule == ClassifyRule::Paper && pair.state != PairState::Near) {
      pair.state = PairState::Free;
      pair.allowed_depth = std::numeric_limits<double>::infinity();
    }
    states.pairs.push_back(pair);
  }
  return states;
}

Result<PairStates> classify_pairs(const Assembly& assembly, const ClassifyOptions& options) {
  ClashOptions clash;
  clash.tolerance = options.tolerance;
  clash.clearance = options.clearance;
  clash.volumes = false;
  clash.executor = options.executor;
  clash.progress = options.progress;
  Result<Clashes> clashes = find_clashes(assembly, clash);
  if (!clashes) return clashes.error();
  return pair_states(*clashes, options.rule);
}

}  // namespace dismantle
