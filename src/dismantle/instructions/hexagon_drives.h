// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/revolution_axes.h"

#include <vector>

namespace dismantle {

/// A hexagon about an axis that a tool takes hold of.
struct HexagonDrive {
  enum class Kind {
    Head,    ///< Faces outward: a spanner fits.
    Socket,  ///< Faces inward: a hexagon key fits.
  };
  Kind kind = Kind::Head;
  double across_flats = 0;  ///< [mm]
};

/// The hexagons of a mesh about an axis: six plane faces around it at one distance, which all the surface along the
/// axis at that distance belongs to. Of several at one distance, one. A surface that is cut up otherwise may hide one.
std::vector<HexagonDrive> hexagon_drives(const TriangleMesh& mesh, const RevolutionAxis& axis);

}  // namespace dismantle
