// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/choose_streams_backend.h"

#include "dismantle/exec/cuda_device.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

Assembly assembly_of(const TriangleMesh& mesh) {
  return scenes::assembly({scenes::component("part", mesh)});
}

TEST(ChooseStreamsBackend, TakesTheCpuSilentlyIfRequested) {
  const ChosenStreamsBackend chosen =
      choose_streams_backend(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), {}, DeviceChoice::Cpu);
  EXPECT_TRUE(chosen.backend);
  EXPECT_EQ(chosen.device, "cpu");
  EXPECT_EQ(chosen.why, "");
}

TEST(ChooseStreamsBackend, TakesCudaOrSaysWhyNot) {
  const ChosenStreamsBackend chosen =
      choose_streams_backend(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), {}, DeviceChoice::Cuda);
  EXPECT_TRUE(chosen.backend);
  const Result<std::string> cuda = cuda_device_name();
  EXPECT_EQ(chosen.device, cuda ? *cuda : "cpu");
  EXPECT_EQ(chosen.why.empty(), cuda.ok());
}

TEST(ChooseStreamsBackend, TakesCudaByItselfOnlyForManyTriangles) {
  const ChosenStreamsBackend few =
      choose_streams_backend(assembly_of(scenes::box({0, 0, 0}, {1, 1, 1})), {}, DeviceChoice::Auto);
  EXPECT_EQ(few.device, "cpu");
  EXPECT_EQ(few.why, "");
  const ChosenStreamsBackend many =
      choose_streams_backend(assembly_of(scenes::tube(10, 5, 0, 20, 200, 60)), {}, DeviceChoice::Auto);
  const Result<std::string> cuda = cuda_device_name();
  EXPECT_EQ(many.device, cuda ? *cuda : "cpu");
  EXPECT_EQ(many.why, "");
}

}  // namespace
}  // namespace dismantle
