// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/engine/device_choice.h"
#include "dismantle/streams/streams_backend.h"

#include <memory>
#include <string>

namespace dismantle {

struct ChosenStreamsBackend {
  std::unique_ptr<StreamsBackend> backend;
  std::string device;  ///< "cpu", or the CUDA device's name.
  std::string why;     ///< Cuda was asked for: why it is the CPU all the same; else empty.
};

/// From so many triangles on Auto takes a CUDA device: a step takes CPUs milliseconds then (docs/evaluation.md), many
/// times what its some fifty launches should. An estimate: no GPU was at hand to measure it on.
inline constexpr std::size_t kCudaWorthTriangles = 5'000;

/// The backend for an assembly, all components in the assembled state.
ChosenStreamsBackend choose_streams_backend(const Assembly& assembly, const CollisionOptions& options,
                                            DeviceChoice choice);

}  // namespace dismantle
