// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/revolution_axes.h"

#include <vector>

namespace dismantle {

/// A hexagonal drive about an axis.
struct HexagonDrive {
  /// Which tool fits.
  enum class Kind {
    Head,    ///< Faces point outward: a spanner (wrench).
    Socket,  ///< Faces point inward: a hex key.
  };
  Kind kind = Kind::Head;   ///< External or internal.
  double across_flats = 0;  ///< Size of the tool [mm].
};

/// Detects the hexagonal drives of a mesh about an axis: six plane faces parallel to the axis at one distance, which
/// make up nearly all of the surface that is parallel to the axis at that distance. Reports one drive per distance; may
/// miss drives whose faces are interrupted.
std::vector<HexagonDrive> hexagon_drives(const TriangleMesh& mesh, const RevolutionAxis& axis);

}  // namespace dismantle
