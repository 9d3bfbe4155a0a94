// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/choose_certificate_device.h"

#include "dismantle/exec/cuda_device.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(ChooseCertificateDevice, TakesTheCpuSilentlyUnlessCudaIsRequested) {
  for (const DeviceChoice choice : {DeviceChoice::Cpu, DeviceChoice::Auto}) {
    const ChosenCertificateDevice chosen = choose_certificate_device(choice);
    EXPECT_FALSE(chosen.use.fronts);
    EXPECT_EQ(chosen.device, "cpu");
    EXPECT_EQ(chosen.why, "");
  }
}

TEST(ChooseCertificateDevice, TakesCudaForEverySweepOrSaysWhyNot) {
  const ChosenCertificateDevice chosen = choose_certificate_device(DeviceChoice::Cuda);
  const Result<std::string> cuda = cuda_device_name();
  EXPECT_EQ(chosen.use.fronts != nullptr, cuda.ok());
  EXPECT_EQ(chosen.device, cuda ? *cuda : "cpu");
  EXPECT_EQ(chosen.why.empty(), cuda.ok());
}

}  // namespace
}  // namespace dismantle
