// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/exec/executor.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/surface/surface_tree.h"
#include "dismantle/surface/winding_number.h"

#include <memory>
#include <vector>

namespace dismantle {

class ShallowRegion;
class ThinPlaces;

/// The surface of a component in the assembled state and its winding number, for queries about solids with faulty
/// meshes. Immutable to all queries; may be shared between threads.
class SolidShape {
 public:
  /// An empty shape.
  SolidShape();
  /// Builds the shape of a component: the same one on every executor.
  explicit SolidShape(const Component& component, const Executor& executor = {});
  /// Takes over another one, which is empty afterwards.
  SolidShape(SolidShape&&) noexcept;
  /// The same; what was here is gone.
  SolidShape& operator=(SolidShape&&) noexcept;
  ~SolidShape();

  /// True for a component without faces; no other function may be called then.
  bool empty() const { return surface_ == nullptr; }
  /// Its triangles [mm, assembly frame].
  const SurfaceTree& surface() const { return *surface_; }
  /// Its winding number [mm, assembly frame].
  const WindingNumber& winding() const { return *winding_; }
  /// One vertex of each connected part of the surface [mm, assembly frame]. A part that does not intersect
  /// a closed surface is on one side of it, that of its vertex.
  const std::vector<Vec3>& shell_points() const { return shell_points_; }
  /// Where no point is deeper than `limit` [mm]; kept, as it is refined where it is asked.
  const ShallowRegion& shallow_region(double limit) const;
  /// Where no point is deeper than `far_limit`, or than `limit` next to a face that is not at a thin place [mm]; kept.
  const ShallowRegion& far_region(double limit, double far_limit) const;
  /// Where `limit` [mm] keeps nothing from passing through; kept.
  const ThinPlaces& thin_places(double limit) const;

 private:
  struct Regions;

  std::unique_ptr<const SurfaceTree> surface_;
  std::unique_ptr<const WindingNumber> winding_;
  std::unique_ptr<Regions> regions_;
  std::vector<Vec3> shell_points_;
};

/// A shape at a pose.
struct PlacedShape {
  const SolidShape* shape = nullptr;    ///< Never null.
  RigidTransform world_from_assembled;  ///< The pose.
};

}  // namespace dismantle
