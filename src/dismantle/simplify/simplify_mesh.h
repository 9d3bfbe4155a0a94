// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <cstddef>

namespace dismantle {

/// Fewer triangles by edge collapses in the order of Garland and Heckbert's quadric error metric (QSlim, 1997; the step
/// that Du et al. 2015 take their test models through), by meshoptimizer. The vertices are vertices of the original;
/// how far the surface moved is what hausdorff_distance tells.
///
/// A mesh that is closed and consistently oriented with positive volume stays so: where the collapse to the target
/// would break that, a less aggressive one is taken, at worst the original. The count may stay above `target_triangles`
/// for that reason, or because topology forbids more collapses. Gives the mesh itself where it has no more than the
/// target.
TriangleMesh simplify_mesh(const TriangleMesh& mesh, std::size_t target_triangles);

}  // namespace dismantle
