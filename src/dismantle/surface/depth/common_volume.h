// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"

#include <cstddef>

namespace dismantle {

/// Accuracy and effort of common_volume().
struct VolumeOptions {
  double relative_error = 0.01;  ///< Standard error to reach, as a part of the volume.
  std::size_t rays = 8000;       ///< The search ends after about as many rays.
};

/// An estimate of a volume.
struct CommonVolume {
  double volume = 0;          ///< [mm^3]
  double standard_error = 0;  ///< [mm^3]
  std::size_t rays = 0;       ///< What it cost.
};

/// The volume that two components at two poses have in common, by parallel rays in a grid of cells, in that one of
/// three directions in which they differ least; cells where they differ most get more of them. Inside is where the
/// winding number of a mesh whose holes are closed by fans (WindingNumber) is not 0. The estimate is unbiased, and most
/// often within twice the standard error, which is below 1% of the volume unless the rays are used up before; what only
/// few cells have is found with the error of those that hit it. The result depends on the components, poses and options
/// alone.
CommonVolume common_volume(const PlacedShape& a, const PlacedShape& b, const VolumeOptions& options = {});

}  // namespace dismantle
