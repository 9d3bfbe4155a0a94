// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/choose_certificate_device.h"

#include "dismantle/exec/cuda_device.h"

namespace dismantle {

ChosenCertificateDevice choose_certificate_device(const Assembly& assembly, DeviceChoice choice) {
  ChosenCertificateDevice chosen{{}, "cpu", "", nullptr};
  const bool predicted = choice == DeviceChoice::Auto;
  if (choice == DeviceChoice::Cpu || (predicted && triangle_count(assembly) < kCudaWorthCertificateTriangles))
    return chosen;
  const Result<std::string> name = cuda_device_name();
  Result<std::unique_ptr<FrontDevice>> fronts = make_cuda_front_device();
  if (name && fronts) {
    auto failure = std::make_shared<DeviceFailure>();
    return {{std::move(*fronts), predicted ? kCudaWorthPairs : 0, failure}, *name, "", failure};
  }
  if (!predicted) chosen.why = fronts.error().message;
  return chosen;
}

}  // namespace dismantle
