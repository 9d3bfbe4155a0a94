// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_report.h"

#include <algorithm>

namespace dismantle {

std::string_view name_of(AuditViolationKind kind) {
  switch (kind) {
    case AuditViolationKind::PathInconsistent:
      return "path-inconsistent";
    case AuditViolationKind::Depth:
      return "depth";
    case AuditViolationKind::Crossing:
      return "crossing";
  }
  return "";
}

std::size_t AuditReport::count(PathPairState state) const {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [state](const AuditPair& pair) { return pair.state == state; }));
}

}  // namespace dismantle
