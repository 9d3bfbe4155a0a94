// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/device_choice.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/streams/streams_backend.h"

#include <memory>
#include <string>

namespace dismantle {

/// A backend and the device that it runs on.
struct ChosenStreamsBackend {
  std::unique_ptr<StreamsBackend> backend;  ///< All components in the assembled state.
  std::string device;                       ///< "cpu", or the CUDA device's name.
  std::string why;  ///< DeviceChoice::Cuda: the reason for running on the CPU instead; else empty.
  /// Says while the backend runs if its device failed and the CPU took over; null on the CPU.
  std::shared_ptr<const DeviceFailure> failure;
};

/// Number of triangles from which DeviceChoice::Auto takes a CUDA device: from there on, an H200 was faster than 16
/// threads in every scene measured (docs/gpu.md).
inline constexpr std::size_t kCudaWorthTriangles = 5'000;

/// Makes a backend for an assembly, with all components in the assembled state. @param assembly must outlive it
ChosenStreamsBackend choose_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                            DeviceChoice choice);

}  // namespace dismantle
