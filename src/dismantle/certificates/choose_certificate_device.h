// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/device_choice.h"

#include <string>

namespace dismantle {

struct ChosenCertificateDevice {
  CertificateDevice use;  ///< For the engine.
  std::string device;     ///< "cpu", or the CUDA device's name.
  std::string why;        ///< Cuda was asked for: why it is the CPU all the same; else empty.
};

/// What Auto predicts work by. From so many triangles on it takes a CUDA device: fronts of fewer hardly ever grow to as
/// many pairs as make a sweep worth asking. Sweeps of so many pairs ask: to check them takes a core 0.14 ms (2.1 ns a
/// pair in lanes of AVX-512), about what a device's launches and copies should. Estimates: no GPU was at hand to
/// measure them on.
inline constexpr std::size_t kCudaWorthCertificateTriangles = 100'000;
inline constexpr std::size_t kCudaWorthPairs = 65'536;

/// The device that an engine of method `certificates` over this assembly asks. Cuda asks in every sweep.
ChosenCertificateDevice choose_certificate_device(const Assembly& assembly, DeviceChoice choice);

}  // namespace dismantle
