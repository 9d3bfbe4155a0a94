// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/matrix_stream.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

const RigidTransform kOne = transform_from_pose({{1, 0, 0}, {}});
const RigidTransform kOther = transform_from_pose({{0, 1, 0}, {}});

using Ids = std::vector<ComponentId>;

TEST(MatrixStream, KnowsWhichComponentsMoveAsOne) {
  MatrixStream stream(5);
  stream.set_next(std::vector<RigidTransform>{{}, kOne, kOther, kOne, {}});
  const Span<const std::uint32_t> c = stream.motion_class();
  EXPECT_EQ(c[0], 0u);
  EXPECT_EQ(c[4], 0u);
  EXPECT_EQ(c[1], c[3]);
  EXPECT_NE(c[1], 0u);
  EXPECT_NE(c[2], c[1]);
  EXPECT_NE(c[2], 0u);
}

TEST(MatrixStream, ListsTheComponentsWhoseVerticesMustBeUpdated) {
  MatrixStream stream(3);
  EXPECT_EQ(stream.set_next(std::vector<RigidTransform>{{}, kOne, {}}), Ids{ComponentId(1)});
  EXPECT_TRUE(stream.set_next(std::vector<RigidTransform>{{}, kOne, {}}).empty());
  stream.commit();  // the vertices at the end become those at the start
  EXPECT_EQ(stream.set_next(std::vector<RigidTransform>{{}, kOne, {}}), Ids{ComponentId(1)});
  EXPECT_EQ(stream.set_start(std::vector<RigidTransform>{kOther, kOne, {}}), Ids{ComponentId(0)});
}

TEST(MatrixStream, ListsTheComponentsWhoseBoundsMustBeUpdatedOnce) {
  MatrixStream stream(3);
  EXPECT_TRUE(stream.take_outdated_bounds().empty());
  stream.set_next(std::vector<RigidTransform>{{}, kOne, {}});
  EXPECT_EQ(stream.take_outdated_bounds(), Ids{ComponentId(1)});
  EXPECT_TRUE(stream.take_outdated_bounds().empty());
  stream.commit();
  stream.set_next(std::vector<RigidTransform>{{}, kOne, kOther});
  EXPECT_EQ(stream.take_outdated_bounds(), (Ids{ComponentId(1), ComponentId(2)}));
}

}  // namespace
}  // namespace dismantle
