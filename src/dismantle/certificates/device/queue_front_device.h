// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/device/device_fronts.h"
#include "dismantle/certificates/device/front_device.h"

#include <map>
#include <utility>

namespace dismantle {

/// The elementary tests of sweeps on a device, with copies of the components' triangles in its memory.
class DeviceTrianglePairs {
 public:
  using Sweep = TrianglePairSweep;
  using Kernel = TrianglePairSweepKernel;
  using Found = TrianglePairResult;

  /// What tests as `sweep` does, over solids in the device's memory. Solids that it does not know go there.
  template <class Queue>
  Kernel kernel(Queue& queue, const TrianglePairSweep& sweep) {
    Kernel kernel = sweep.kernel();
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
    return {copy.vertices.view().data(), copy.faces.view().data(), copy.normals.view().data(),
            copy.around_begin.view().data(), copy.around.view().data()};
  }

  std::map<const SolidTree*, Solid> solids_;
};

/// Fronts and elementary tests on the device that `Queue` is: HostQueue or CudaQueue.
template <class Queue>
class QueueFrontDevice final : public FrontDevice {
 public:
  /// @param capacity that everything starts with
  QueueFrontDevice(Queue queue, std::size_t capacity) : fronts_(std::move(queue), capacity) {}

  FrontResults ask(Span<const FrontQuery<TrianglePairSweep>> fronts, bool to_the_end) override {
    const Span<const PartResults> parts = fronts_.ask(fronts, to_the_end);
    return {parts, fronts_.leaves()};
  }
  Span<const NodeSeparation> separate(Span<const FrontQuery<TrianglePairSweep>> fronts,
                                      Span<const MergeCandidate> pairs) override {
    return fronts_.separate(fronts, pairs);
  }

 private:
  DeviceFronts<Queue, DeviceTrianglePairs> fronts_;
};

}  // namespace dismantle
