// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/narrowphase/coplanarity_cubic.h"

namespace dismantle {

/// The deforming non-penetration filter (Tang, Manocha, Tong, "Fast continuous collision detection using deforming
/// non-penetration filters", I3D 2010; Du et al. 2015, section 4.3): a cubic whose Bernstein coefficients all have one
/// sign has no root in [0, 1]. True only if the four exact coefficients certainly have one strict sign: the points are
/// then never coplanar, and there is no contact. False proves nothing.
DISMANTLE_HOST_DEVICE inline bool certainly_never_coplanar(const BernsteinCubic& cubic) {
  const double e = cubic.error;
  const bool above = cubic.c[0] > e && cubic.c[1] > e && cubic.c[2] > e && cubic.c[3] > e;
  const bool below = cubic.c[0] < -e && cubic.c[1] < -e && cubic.c[2] < -e && cubic.c[3] < -e;
  return above || below;
}

/// True if the filter proves that the vertex and the face do not meet during the motion.
DISMANTLE_HOST_DEVICE inline bool nonpenetration_filter(const VertexFaceMotion& motion) {
  return certainly_never_coplanar(coplanarity_cubic(motion));
}

/// True if the filter proves that the edges do not meet during the motion.
DISMANTLE_HOST_DEVICE inline bool nonpenetration_filter(const EdgeEdgeMotion& motion) {
  return certainly_never_coplanar(coplanarity_cubic(motion));
}

}  // namespace dismantle
