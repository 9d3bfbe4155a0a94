// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/bvh/radial_bounds.h"
#include "dismantle/exec/executor.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dismantle {

/// A component as the method `certificates` sees it: its triangles in the assembled state, and their tree.
struct SolidTree {
  std::vector<Vec3> vertices;  ///< [mm, assembled]
  Span<const Face> faces;
  bool has_outside = false;  ///< It encloses a volume, and its normals point out of it (MeshFaults::bounds_solid).
  ObbTree tree;
  std::unique_ptr<const RevolutionSurface> round;  ///< What of it turns about an axis; null where it has no faces.
  std::vector<Vec3> normals;                       ///< Unit, of each face; where it has an outside.
  std::vector<std::uint32_t> around_begin;  ///< Where each vertex's faces begin in `around`, and the end of the last.
  std::vector<std::uint32_t> around;        ///< The faces at each vertex.

  Triangle triangle(std::uint32_t face) const {
    const Face& f = faces[face];
    return {{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
  }
};

/// @param component must outlive the tree, which looks at its faces
SolidTree make_solid_tree(const Component& component, const Executor& executor);

}  // namespace dismantle
