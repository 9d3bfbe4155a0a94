// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/units.h"

#include <gtest/gtest.h>

namespace dismantle {

TEST(Units, GiveMillimetres) {
  EXPECT_EQ(*millimetres_per_unit("mm"), 1);
  EXPECT_EQ(*millimetres_per_unit("cm"), 10);
  EXPECT_EQ(*millimetres_per_unit("m"), 1000);
  EXPECT_EQ(*millimetres_per_unit("um"), 0.001);
  EXPECT_EQ(*millimetres_per_unit("in"), 25.4);
  EXPECT_EQ(*millimetres_per_unit("ft"), 304.8);
}

TEST(Units, RefuseUnknownNames) {
  for (const char* name : {"", "MM", "mile", "mm "}) {
    const auto result = millimetres_per_unit(name);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::Usage);
  }
}

}  // namespace dismantle
