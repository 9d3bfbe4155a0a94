// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_shape.h"

namespace dismantle {

SolidShape::SolidShape(const Component& component, const Executor& executor) {
  const TriangleMesh mesh = assembled_mesh(component);
  if (mesh.faces.empty()) return;
  surface_ = std::make_unique<const SurfaceTree>(mesh, executor);
  winding_ = std::make_unique<const WindingNumber>(mesh, *surface_);
}

}  // namespace dismantle
