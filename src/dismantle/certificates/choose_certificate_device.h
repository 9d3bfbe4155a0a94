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

/// Chooses the device for an engine of method `certificates`. DeviceChoice::Auto is the CPU: on an H200 every scene
/// measured took 1.7 to 4.6 times as long as on 16 threads (docs/gpu.md), as fronts are small and a sweep needs
/// little.
ChosenCertificateDevice choose_certificate_device(DeviceChoice choice);

}  // namespace dismantle
