// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_shape.h"

#include "dismantle/surface/depth/shallow_region.h"

#include <map>
#include <mutex>

namespace dismantle {

struct SolidShape::Regions {
  std::mutex mutex;
  std::map<double, std::unique_ptr<const ShallowRegion>> of_limit;
};

SolidShape::SolidShape() = default;
SolidShape::SolidShape(SolidShape&&) noexcept = default;
SolidShape& SolidShape::operator=(SolidShape&&) noexcept = default;
SolidShape::~SolidShape() = default;

SolidShape::SolidShape(const Component& component, const Executor& executor) {
  const TriangleMesh mesh = assembled_mesh(component);
  if (mesh.faces.empty()) return;
  surface_ = std::make_unique<const SurfaceTree>(mesh, executor);
  winding_ = std::make_unique<const WindingNumber>(mesh, *surface_);
  regions_ = std::make_unique<Regions>();
}

const ShallowRegion& SolidShape::shallow_region(double limit) const {
  const std::lock_guard lock(regions_->mutex);
  std::unique_ptr<const ShallowRegion>& region = regions_->of_limit[limit];
  if (!region) region = std::make_unique<const ShallowRegion>(*surface_, *winding_, limit);
  return *region;
}

}  // namespace dismantle
