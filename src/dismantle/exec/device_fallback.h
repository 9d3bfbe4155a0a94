// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/cuda_device.h"

#include <functional>
#include <memory>
#include <utility>

namespace dismantle {

/// An object that computes on a device, and its replacement on the CPU once the device fails (CudaError). The device is
/// not tried again.
template <class T>
class DeviceFallback {
 public:
  /// Makes the replacement.
  using Make = std::function<std::unique_ptr<T>()>;

  /// @param on_device used until it fails @param failure set then
  DeviceFallback(std::unique_ptr<T> on_device, Make make_other, std::shared_ptr<DeviceFailure> failure)
      : used_(std::move(on_device)), make_other_(std::move(make_other)), failure_(std::move(failure)) {}

  /// The object in use.
  T& used() const { return *used_; }

  /// Calls call(used()). If the device fails, calls take_over(used()) with the replacement instead, which brings it to
  /// the state of the failed object and repeats the call.
  template <class Call, class TakeOver>
  void try_on(const Call& call, const TakeOver& take_over) {
    try {
      call(*used_);
      return;
    } catch (const CudaError& error) {
      if (!make_other_) throw;
      failure_->why = error.what();
    }
    failed_ = std::exchange(used_, std::exchange(make_other_, nullptr)());
    take_over(*used_);
  }

 private:
  std::unique_ptr<T> used_, failed_;  // data of the failed one may still be referred to
  Make make_other_;                   // empty once it was used
  std::shared_ptr<DeviceFailure> failure_;
};

}  // namespace dismantle
