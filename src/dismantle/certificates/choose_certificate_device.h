// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/device_choice.h"

#include <string>

namespace dismantle {

/// The device chosen by choose_certificate_device().
struct ChosenCertificateDevice {
  CertificateDevice use;  ///< For the engine.
  std::string device;     ///< "cpu", or the name of the CUDA device.
  std::string why;        ///< If CUDA was requested and the CPU chosen: the reason; else empty.
  /// Says while the engine runs if its device failed and the CPU took over; null on the CPU.
  std::shared_ptr<const DeviceFailure> failure;
};

///@{ Thresholds of DeviceChoice::Auto: triangles of an assembly, and pairs of a sweep, from which on it uses a CUDA
/// device. Fronts of fewer triangles hardly ever grow to as many pairs. To check so many pairs takes a core 0.14 ms
/// (2.1 ns a pair in lanes of AVX-512), about the time expected for a device's launches and copies. Estimates, not
/// measured on a GPU.
inline constexpr std::size_t kCudaWorthCertificateTriangles = 100'000;
inline constexpr std::size_t kCudaWorthPairs = 65'536;
///@}

/// Chooses the device for an engine of method `certificates` over this assembly. DeviceChoice::Cuda uses it in every
/// sweep.
ChosenCertificateDevice choose_certificate_device(const Assembly& assembly, DeviceChoice choice);

}  // namespace dismantle
