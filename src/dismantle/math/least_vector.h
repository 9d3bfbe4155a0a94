// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/math/vec3.h"

#include <optional>

namespace dismantle {

/// The half-space of vectors v with dot(normal, v) >= distance.
struct VectorBound {
  Vec3 normal;          ///< Unit.
  double distance = 0;  ///< [mm]
};

/// The shortest vector within all bounds, up to a relative rounding of about 1e-9; nothing where there is none. Takes a
/// time that is linear in the number of bounds for all but contrived orders (Seidel 1991).
std::optional<Vec3> least_vector(Span<const VectorBound> bounds);

}  // namespace dismantle
