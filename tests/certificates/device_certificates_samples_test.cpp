// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"
#include "dismantle/loading/load_assembly.h"
#include "tests/support/device_certificates.h"

namespace dismantle {
namespace {

using DeviceCertificatesOfSamples = DeviceCertificates;

INSTANTIATE_TEST_SUITE_P(On, DeviceCertificatesOfSamples, testing::ValuesIn(kCertificateDevices), name_of_device);

TEST_P(DeviceCertificatesOfSamples, PlayTheMicroscopesMotionLikeTheCpu) {
  const std::string sample = DISMANTLE_SOURCE_DIR "/samples/microscope";
  const Assembly assembly = load_assembly(sample + ".step").value();
  Motion motion = read_motion(sample + ".motion.json").value();
  for (MotionMove& move : motion.moves)
    if (move.targets.size() > 12) move.targets.resize(12);
  for (const ResponseKind response : {ResponseKind::Touch, ResponseKind::Slide}) {
    motion.response = response;
    EXPECT_GT(expect_same(assembly, 0.01, motion).decided, 1000u);
  }
}

}  // namespace
}  // namespace dismantle
