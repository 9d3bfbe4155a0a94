// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_kernels.h"
#include "dismantle/surface/solid_tree.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dismantle {

/// Pairs of faces of two components.
using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Two components in the assembled state.
struct NearFacesRequest {
  const SolidTree* own = nullptr;    ///< One of them, or its ghost surface; never null.
  const SolidTree* other = nullptr;  ///< The other one; never null.
  double reach = 0;                  ///< [mm]
  double tolerance = 0;              ///< [mm]
  FrontKernels kernels;              ///< Any.
  std::size_t most = 0;              ///< Where there are more pairs, some are left out.
};

/// The pairs of faces of two components that are nearer to each other than `reach`, and some more.
FacePairs near_face_pairs(const NearFacesRequest& request);

}  // namespace dismantle
