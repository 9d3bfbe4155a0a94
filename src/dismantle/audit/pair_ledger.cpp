// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/pair_ledger.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

PairLedger::PairLedger(const Assembly& assembly, const Path& path) {
  ordinary_.allowed = std::isfinite(path.tolerance) ? std::max(0.0, path.tolerance) : 0;
  for (const PathPair& pair : path.pairs) {
    const auto a = assembly.find(pair.a), b = assembly.find(pair.b);
    if (!a || !b || *a == *b) continue;
    PairRecord& record = get(std::min(*a, *b).value, std::max(*a, *b).value);
    if (pair.state == PairState::Free) {
      record.embedded = true;
    } else if (pair.state == PairState::Overlapping && std::isfinite(pair.allowed_penetration)) {
      record.allowed = std::max(record.allowed, pair.allowed_penetration);
    }
  }
}

const PairRecord& PairLedger::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = records_.find({a, b});
  return found != records_.end() ? found->second : ordinary_;
}

PairRecord& PairLedger::get(std::uint32_t a, std::uint32_t b) {
  return records_.try_emplace({a, b}, ordinary_).first->second;
}

}  // namespace dismantle::audit
