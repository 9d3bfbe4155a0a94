// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/choose_certificate_device.h"

#include "dismantle/exec/cuda_device.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Assembly assembly_of(const TriangleMesh& mesh) {
  return scenes::assembly({scenes::component("part", mesh)});
}

TEST(ChooseCertificateDevice, TakesTheCpuSilentlyIfRequested) {
  const ChosenCertificateDevice chosen =
      choose_certificate_device(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), DeviceChoice::Cpu);
  EXPECT_FALSE(chosen.use.fronts);
  EXPECT_EQ(chosen.device, "cpu");
  EXPECT_EQ(chosen.why, "");
}

TEST(ChooseCertificateDevice, TakesCudaForEverySweepOrSaysWhyNot) {
  const ChosenCertificateDevice chosen =
      choose_certificate_device(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), DeviceChoice::Cuda);
  const Result<std::string> cuda = cuda_device_name();
  EXPECT_EQ(chosen.use.fronts != nullptr, cuda.ok());
  EXPECT_EQ(chosen.use.min_pairs, 0u);
  EXPECT_EQ(chosen.device, cuda ? *cuda : "cpu");
  EXPECT_EQ(chosen.why.empty(), cuda.ok());
}

TEST(ChooseCertificateDevice, TakesCudaAutomaticallyOnlyForManyTrianglesAndLargeSweeps) {
  const ChosenCertificateDevice few =
      choose_certificate_device(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), DeviceChoice::Auto);
  EXPECT_FALSE(few.use.fronts);
  EXPECT_EQ(few.why, "");
  const ChosenCertificateDevice many =
      choose_certificate_device(assembly_of(scenes::tube(10, 5, 0, 20, 300, 100)), DeviceChoice::Auto);
  const Result<std::string> cuda = cuda_device_name();
  EXPECT_EQ(many.use.fronts != nullptr, cuda.ok());
  EXPECT_EQ(many.use.min_pairs, cuda ? kCudaWorthPairs : 0);
  EXPECT_EQ(many.device, cuda ? *cuda : "cpu");
  EXPECT_EQ(many.why, "");
}

}  // namespace
}  // namespace dismantle
