// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_report.h"

namespace dismantle {

std::string_view name_of(AuditViolationKind kind) {
  switch (kind) {
    case AuditViolationKind::PathInconsistent:
      return "path-inconsistent";
    case AuditViolationKind::TrianglesIntersect:
      return "triangles-intersect";
    case AuditViolationKind::VertexInside:
      return "vertex-inside";
    case AuditViolationKind::EmbeddedMetAgain:
      return "embedded-met-again";
  }
  return "";
}

}  // namespace dismantle
