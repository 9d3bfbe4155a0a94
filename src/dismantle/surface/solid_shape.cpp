// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/solid_shape.h"

#include "dismantle/core/connected_sets.h"
#include "dismantle/surface/depth/shallow_region.h"
#include "dismantle/surface/depth/thin_places.h"

#include <map>
#include <mutex>
#include <utility>

namespace dismantle {

namespace {

/// A map whose values are made by the first thread that asks for them. Other threads wait only for the same value.
template <class Key, class Value>
class MadeOnce {
 public:
  /// @param make() gives a std::unique_ptr
  template <class Make>
  const Value& get(const Key& key, const Make& make) {
    Entry& entry = entry_of(key);
    std::call_once(entry.once, [&] { entry.value = make(); });
    return *entry.value;
  }

 private:
  struct Entry {
    std::once_flag once;
    std::unique_ptr<const Value> value;
  };
  Entry& entry_of(const Key& key) {
    const std::lock_guard lock(mutex_);
    return entries_[key];
  }

  std::mutex mutex_;
  std::map<Key, Entry> entries_;
};

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

struct SolidShape::Regions {
  MadeOnce<double, ThinPlaces> thin_places;
  MadeOnce<std::pair<double, double>, ShallowRegion> of_limits;
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
  shell_points_ = vertex_of_each_shell(mesh);
}

const ShallowRegion& SolidShape::shallow_region(double limit) const {
  return far_region(limit, limit);
}

const ShallowRegion& SolidShape::far_region(double limit, double far_limit) const {
  return regions_->of_limits.get({limit, far_limit}, [&] {
    const SurfaceTree* thick = far_limit < limit ? thin_places(limit).thick_faces() : nullptr;
    return std::make_unique<const ShallowRegion>(*surface_, *winding_, far_limit, DeeperFaces{thick, limit});
  });
}

const ThinPlaces& SolidShape::thin_places(double limit) const {
  return regions_->thin_places.get(limit, [&] { return std::make_unique<const ThinPlaces>(*this, limit); });
}

}  // namespace dismantle
