// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/tunnel_count.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

TEST(TunnelCount, IsAboveZeroForTheDiscreteTestOfTrianglesAndZeroForOurMethods) {
  const std::vector<TunnelMethod> methods = tunnel_methods();
  ASSERT_EQ(methods.size(), 4u);
  for (TunnelCase tunnel_case : tunnel_cases()) {
    tunnel_case.steps.resize(32);
    SCOPED_TRACE(tunnel_case.name);
    const std::vector<TunnelCount> counts = count_tunnels(tunnel_case, methods);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      SCOPED_TRACE(methods[m].name);
      EXPECT_EQ(counts[m].steps, tunnel_case.steps.size());
      EXPECT_GT(counts[m].meeting, 10u);
      if (methods[m].name == "boxes (discrete)") {
        EXPECT_GT(counts[m].tunnels, 0u);
      }
      if (methods[m].name != "streams" && methods[m].name != "certificates") continue;
      EXPECT_EQ(counts[m].tunnels, 0u);
      EXPECT_EQ(counts[m].false_stops, 0u);
    }
  }
}

}  // namespace
}  // namespace dismantle
