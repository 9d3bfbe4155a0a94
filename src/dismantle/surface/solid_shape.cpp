// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_shape.h"

#include "dismantle/core/connected_sets.h"
#include "dismantle/surface/depth/shallow_region.h"
#include "dismantle/surface/depth/thin_places.h"

#include <map>
#include <mutex>
#include <utility>

namespace dismantle {

struct SolidShape::Regions {
  std::mutex mutex;
  std::map<double, std::unique_ptr<const ThinPlaces>> thin_places;
  std::map<std::pair<double, double>, std::unique_ptr<const ShallowRegion>> of_limits;
};

namespace {

std::vector<Vec3> vertex_of_each_shell(const TriangleMesh& mesh) {
  ConnectedSets shells(mesh.vertices.size());
  for (const Face& f : mesh.faces)
    for (const int k : {1, 2}) shells.join(f.v[0], f.v[k]);
  std::vector<Vec3> points;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (shells.set_of(v) == v) points.push_back(mesh.vertices[v]);
  return points;
}

}  // namespace

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
  shell_points_ = vertex_of_each_shell(mesh);
}

const ShallowRegion& SolidShape::shallow_region(double limit) const {
  return far_region(limit, limit);
}

const ShallowRegion& SolidShape::far_region(double limit, double far_limit) const {
  const SurfaceTree* thick = far_limit < limit ? thin_places(limit).thick_faces() : nullptr;
  const std::lock_guard lock(regions_->mutex);
  std::unique_ptr<const ShallowRegion>& region = regions_->of_limits[{limit, far_limit}];
  if (!region)
    region = std::make_unique<const ShallowRegion>(*surface_, *winding_, far_limit, DeeperFaces{thick, limit});
  return *region;
}

const ThinPlaces& SolidShape::thin_places(double limit) const {
  const std::lock_guard lock(regions_->mutex);
  std::unique_ptr<const ThinPlaces>& places = regions_->thin_places[limit];
  if (!places) places = std::make_unique<const ThinPlaces>(*this, limit);
  return *places;
}

}  // namespace dismantle
