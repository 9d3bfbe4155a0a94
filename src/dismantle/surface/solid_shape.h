// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/exec/executor.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/surface_tree.h"
#include "dismantle/surface/winding_number.h"

#include <memory>

namespace dismantle {

/// The surface of a component in the assembled state and its winding number, for queries about solids with faulty
/// meshes. Immutable; may be shared between threads.
class SolidShape {
 public:
  /// An empty shape.
  SolidShape() = default;
  /// Builds the shape of a component: the same one on every executor.
  explicit SolidShape(const Component& component, const Executor& executor = {}) {
    const TriangleMesh mesh = assembled_mesh(component);
    if (mesh.faces.empty()) return;
    surface_ = std::make_unique<const SurfaceTree>(mesh, executor);
    winding_ = std::make_unique<const WindingNumber>(mesh, *surface_);
  }

  /// True for a component without faces; no other function may be called then.
  bool empty() const { return surface_ == nullptr; }
  /// Its triangles [mm, assembly frame].
  const SurfaceTree& surface() const { return *surface_; }
  /// Its winding number [mm, assembly frame].
  const WindingNumber& winding() const { return *winding_; }

 private:
  std::unique_ptr<const SurfaceTree> surface_;
  std::unique_ptr<const WindingNumber> winding_;
};

/// A shape at a pose.
struct PlacedShape {
  const SolidShape* shape = nullptr;    ///< Never null.
  RigidTransform world_from_assembled;  ///< The pose.
};

}  // namespace dismantle
