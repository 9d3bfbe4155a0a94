// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/exec/device_array.h"

#include <map>

namespace dismantle {

/// Copies of the components' triangles in a device's memory, for triangle-pair tests there.
class DeviceSolids {
 public:
  /// The kernel of `sweep` over solids in the device's memory. Uploads solids that are not there yet.
  template <class Queue>
  TrianglePairSweepKernel kernel(Queue& queue, const TrianglePairSweep& sweep) {
    TrianglePairSweepKernel kernel = sweep.kernel();
    kernel.moving = copy_of(queue, sweep.moving());
    kernel.fixed = copy_of(queue, sweep.fixed());
    return kernel;
  }

 private:
  struct Solid {
    DeviceArray<Vec3> vertices;
    DeviceArray<Face> faces;
    DeviceArray<Vec3> normals;
    DeviceArray<std::uint32_t> around_begin, around;
  };

  template <class Queue>
  SolidView copy_of(Queue& queue, const SolidTree& solid) {
    auto known = solids_.find(&solid);
    if (known == solids_.end())
      known =
          solids_
              .emplace(&solid, Solid{DeviceArray<Vec3>(queue, Span<const Vec3>(solid.vertices)),
                                     DeviceArray<Face>(queue, solid.faces),
                                     DeviceArray<Vec3>(queue, Span<const Vec3>(solid.normals)),
                                     DeviceArray<std::uint32_t>(queue, Span<const std::uint32_t>(solid.around_begin)),
                                     DeviceArray<std::uint32_t>(queue, Span<const std::uint32_t>(solid.around))})
              .first;
    const Solid& copy = known->second;
    SolidView view{copy.vertices.view().data(), copy.faces.view().data()};
    if (!solid.has_outside) return view;
    view.normals = copy.normals.view().data();
    view.around_begin = copy.around_begin.view().data();
    view.around = copy.around.view().data();
    return view;
  }

  std::map<const SolidTree*, Solid> solids_;
};

}  // namespace dismantle
