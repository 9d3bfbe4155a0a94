// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/motion_batch.h"
#include "dismantle/exec/device_fallback.h"

#include <memory>
#include <utility>
#include <vector>

namespace dismantle {

/// A batch that goes on with another one when its device fails (CudaError): every batch gives the same results.
class FallbackMotionBatch final : public MotionBatch {
 public:
  /// Makes a batch.
  using Make = DeviceFallback<MotionBatch>::Make;

  /// @param on_device used until it fails
  /// @param make_other makes the other one
  FallbackMotionBatch(std::unique_ptr<MotionBatch> on_device, Make make_other, std::shared_ptr<DeviceFailure> failure)
      : fallback_(std::move(on_device), std::move(make_other), std::move(failure)) {}

  void set_state(Span<const Pose> poses, Span<const ComponentId> moving) override {
    poses_.assign(poses.begin(), poses.end());
    moving_.assign(moving.begin(), moving.end());
    try_on([&](MotionBatch& batch) { batch.set_state(poses_, moving_); });
  }
  std::vector<FirstContact> straight_contacts(Span<const Vec3> displacements) override {
    std::vector<FirstContact> contacts;
    try_on([&](MotionBatch& batch) { contacts = batch.straight_contacts(displacements); });
    return contacts;
  }
  std::vector<FirstContact> screw_contacts(Span<const Pose> targets) override {
    std::vector<FirstContact> contacts;
    try_on([&](MotionBatch& batch) { contacts = batch.screw_contacts(targets); });
    return contacts;
  }

 private:
  template <class Call>
  void try_on(const Call& call) {
    fallback_.try_on(call, [&](MotionBatch& other) {
      other.set_state(poses_, moving_);
      call(other);
    });
  }

  DeviceFallback<MotionBatch> fallback_;
  std::vector<Pose> poses_;
  std::vector<ComponentId> moving_;
};

}  // namespace dismantle
