// SPDX-License-Identifier: Apache-2.0
#include "dismantle/engine/classify_pairs.h"

#include "dismantle/surface/find_clashes.h"

#include <limits>
#include <optional>
#include <utility>

namespace dismantle {

PairStates pair_states(const Clashes& clashes, ClassifyRule rule) {
  PairStates states;
  states.tolerance = clashes.tolerance;
  for (const Clash& clash : clashes.pairs) {
    // Where the search ended early, only what was found is allowed: the bound may be far above it.
    const double depth = clash.depth_loose ? clash.depth_attained : clash.depth;
    ComponentPair pair{clash.a, clash.b, PairState::Near, clash.distance, depth, clashes.tolerance};
    if (clash.state == ClashState::Contact) pair.state = PairState::Contact;
    if (clash.state == ClashState::Overlapping) pair.state = PairState::Overlapping;
    if (depth > kShallow * clashes.tolerance) pair.allowed_depth = depth + clashes.tolerance;
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
  PairStates states = pair_states(*clashes, options.rule);
  const Result<Done> declared = declare_allowances(states, assembly, options.declared);
  if (!declared) return declared.error();
  return states;
}

Result<Done> declare_allowances(PairStates& states, const Assembly& assembly, Span<const DeclaredAllowance> declared) {
  for (const DeclaredAllowance& own : declared) {
    const std::optional<ComponentId> a = assembly.find(own.a), b = assembly.find(own.b);
    for (const auto& [id, name] : {std::pair(a, own.a), std::pair(b, own.b)})
      if (!id)
        return Error{ErrorKind::Usage, "no overlap can be allowed for '" + name +
                                           "' (the assembly has no such component); see 'dismantle info'"};
    const ComponentPair* known = states.find(*a, *b);
    if (!known || known->state == PairState::Near)
      return Error{ErrorKind::Usage, "no overlap can be allowed for '" + own.a + "' and '" + own.b +
                                         "' (they do not touch in the assembled state, and an allowance ends where two "
                                         "components have been apart); see 'dismantle check'"};
    states.declare(*a, *b, own.depth);
  }
  return Done{};
}

}  // namespace dismantle
