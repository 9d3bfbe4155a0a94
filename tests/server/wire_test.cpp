// SPDX-License-Identifier: Apache-2.0
#include "apps/server/wire.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/read_file.h"
#include "tests/server/wire_golden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace dismantle::server {
namespace {

const char* kGoldenFile = DISMANTLE_SOURCE_DIR "/tests/server/golden/wire.json";

// DISMANTLE_REMAKE_GOLDEN=1 rewrites the file; a change of it is a new protocol.
TEST(Wire, HasTheGoldenBytes) {
  const std::string now = golden::document().dump(2) + "\n";
  if (std::getenv("DISMANTLE_REMAKE_GOLDEN") != nullptr) {
    ASSERT_TRUE(write_file(kGoldenFile, now).ok());
  }
  const Result<std::string> golden = read_file(kGoldenFile, 1 << 20);
  ASSERT_TRUE(golden.ok());
  EXPECT_EQ(now, *golden);
}

TEST(Wire, HasTheSizesThatItsDescriptionSays) {
  EXPECT_EQ(encode(golden::target()).size(), kTargetBytes);
  EXPECT_EQ(encode(golden::rate()).size(), kRateBytes);
  EXPECT_EQ(encode(golden::pose()).size(), kPoseBytes + 2 * kContactBytes);
}

TEST(Wire, GivesBackWhatWasWritten) {
  const auto target = decode_from_client(encode(golden::target()));
  ASSERT_TRUE(target);
  EXPECT_EQ(std::get<TargetMessage>(*target), golden::target());
  const auto rate = decode_from_client(encode(golden::rate()));
  ASSERT_TRUE(rate);
  EXPECT_EQ(std::get<RateMessage>(*rate), golden::rate());
  const auto pose = decode_pose(encode(golden::pose()));
  ASSERT_TRUE(pose);
  EXPECT_EQ(*pose, golden::pose());
}

TEST(Wire, RefusesNumbersOutOfRange) {
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 1e9, -1e300}) {
    TargetMessage target = golden::target();
    target.pose.position.y = wrong;
    EXPECT_FALSE(decode_from_client(encode(target))) << wrong;
    target = golden::target();
    target.pose.rotation.x = wrong;
    EXPECT_FALSE(decode_from_client(encode(target))) << wrong;
    RateMessage rate = golden::rate();
    rate.angular_velocity.z = wrong;
    EXPECT_FALSE(decode_from_client(encode(rate))) << wrong;
  }
  TargetMessage target = golden::target();
  target.pose.rotation = {0, 0, 0, 0};
  EXPECT_FALSE(decode_from_client(encode(target)));
}

TEST(Wire, MakesRotationsOfUnitLength) {
  TargetMessage target = golden::target();
  target.pose.rotation.w += 1e-7;
  const auto read = decode_from_client(encode(target));
  ASSERT_TRUE(read);
  const Quat q = std::get<TargetMessage>(*read).pose.rotation;
  EXPECT_NEAR(dot(q, q), 1, 1e-15);
}

TEST(Wire, ReadsNoMessageOfAnotherLength) {
  const std::string messages[] = {encode(golden::target()), encode(golden::rate())};
  for (const std::string& whole : messages) {
    for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_FALSE(decode_from_client(whole.substr(0, n))) << n;
    EXPECT_FALSE(decode_from_client(whole + '\0'));
  }
  const std::string pose = encode(golden::pose());
  for (std::size_t n = 0; n < pose.size(); ++n) EXPECT_FALSE(decode_pose(pose.substr(0, n))) << n;
}

TEST(Wire, SurvivesAnyBytes) {
  std::mt19937 random(5);
  std::size_t read = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string bytes(random() % 160, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    if (i % 2 == 0 && !bytes.empty()) bytes[0] = static_cast<char>(1 + random() % 2);
    read += decode_from_client(bytes).has_value();
    read += decode_pose(bytes).has_value();
  }
  EXPECT_EQ(read, 0u);  // no random number is a unit quaternion, no random length right
}

}  // namespace
}  // namespace dismantle::server
