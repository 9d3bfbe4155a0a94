// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/choose_certificate_device.h"

#include "dismantle/exec/cuda_device.h"

namespace dismantle {

ChosenCertificateDevice choose_certificate_device(DeviceChoice choice) {
  ChosenCertificateDevice chosen{{}, "cpu", "", nullptr};
  if (choice != DeviceChoice::Cuda) return chosen;
  const Result<std::string> name = cuda_device_name();
  Result<std::unique_ptr<FrontDevice>> fronts = make_cuda_front_device();
  if (name && fronts) {
    auto failure = std::make_shared<DeviceFailure>();
    return {{std::move(*fronts), failure}, *name, "", failure};
  }
  chosen.why = fronts.error().message;
  return chosen;
}

}  // namespace dismantle
