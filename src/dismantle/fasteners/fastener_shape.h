// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/fastener.h"
#include "dismantle/geometry/triangle_mesh.h"

#include <vector>

namespace dismantle {

/// A fastener that a shape may be.
struct FastenerShape {
  /// How much the shape says.
  enum class Certainty {
    Possible,  ///< Other parts look like this, too: only a name can tell.
    Likely,    ///< Its sizes are of a standard, but parts that are no fasteners may have them.
    Certain,   ///< It has a drive or a thread, or is a hexagon nut of a standard.
  };
  Fastener fastener;                          ///< Without what only a name says.
  Certainty certainty = Certainty::Possible;  ///< How much the shape says.
};

/// The fasteners that a mesh may be by its shape, the most certain first: by its sections about its axis (head and
/// shank, ring, hexagon), drives, thread, and sizes of standards. Empty for all other shapes.
std::vector<FastenerShape> fastener_shapes(const TriangleMesh& mesh);

}  // namespace dismantle
