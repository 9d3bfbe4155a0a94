// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/bvh/sphere_tree.h"
#include "dismantle/core/span.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/shape_features.h"
#include "dismantle/surface/surface_tree.h"

#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// Tells the components that lie open to the outside in the assembled state from those that others enclose. A component
/// is exposed if a quarter of the light that comes from all around reaches some point of its surface, as far as points
/// and rays sampled tell (the openness of ambient occlusion: Zhukov, Iones, Kronin 1998). It may be free to move and
/// not be exposed: a small part that passes through an opening of its housing. May be asked about different components
/// at the same time.
class Exposure {
 public:
  /// Both must outlive this. @param features of every component
  Exposure(const Assembly& assembly, Span<const ShapeFeatures> features);

  /// True if a component is exposed among `present`. One that was exposed among others counts as exposed.
  bool is_exposed(ComponentId c, const ComponentSet& present);
  /// A subset of `gone` whose removal is enough to expose `c` among `present`: small, but not always the smallest.
  /// Nothing if `c` is not exposed even without all of `gone`.
  std::optional<std::vector<ComponentId>> opened_by(ComponentId c, const ComponentSet& present,
                                                    const ComponentSet& gone);

 private:
  /// A point on the surface, and what is met by rays from it.
  struct Sample {
    Vec3 point, normal;                  // [mm, assembly frame]; the normal is a unit vector that points outwards
    std::vector<std::uint32_t> blocker;  // of each ray that was tested: kFree, or a component that it meets
  };
  enum class State : std::uint8_t { Unknown, Enclosed, Exposed };
  struct Tested {
    State state = State::Unknown;
    std::vector<Sample> samples;  // of one that was enclosed
  };

  std::vector<Sample> samples_of(ComponentId c) const;
  std::optional<std::vector<ComponentId>> opened_by(const Sample& sample, ComponentId own, const ComponentSet& present,
                                                    const ComponentSet& gone);
  bool is_open(Sample& sample, ComponentId own, const ComponentSet& present);
  /// A component of `present` that a ray [assembly frame] meets; invalid for none. @param likely those to try first
  ComponentId blocker(Vec3 point, Vec3 direction, Span<const ComponentId> likely, const ComponentSet& present);
  /// Calls visit(component) for those whose spheres a ray meets, until it returns false.
  template <class Visit>
  void for_each_near(Vec3 point, Vec3 direction, const Visit& visit) const;
  bool meets(Vec3 point, Vec3 direction, ComponentId c);

  const Assembly& assembly_;
  SphereTree spheres_;  // of all components
  /// The tree of a mesh, once a ray is tested with it.
  struct RayTree {
    std::once_flag once;
    std::optional<SurfaceTree> tree;
  };
  std::unordered_map<const TriangleMesh*, RayTree> meshes_;
  std::vector<Tested> tested_;  // of each component
};

}  // namespace dismantle
