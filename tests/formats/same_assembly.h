// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace dismantle {

/// Expects that two assemblies have the same components, in any order and with any names: components that enclose the
/// same volume, within `relative` of it, in the same box, within `distance` [mm].
inline void expect_same_components(const Assembly& a, const Assembly& b, double relative, double distance) {
  const auto sorted = [](const Assembly& assembly) {
    struct Measured {
      double volume;
      Aabb box;
    };
    std::vector<Measured> all;
    for (const Component& c : assembly.components) all.push_back({signed_volume(*c.mesh), assembled_bounds(c)});
    const auto grid = [](double v) { return std::round(v / 0.5); };  // boxes that are the same compare the same
    std::sort(all.begin(), all.end(), [&](const Measured& x, const Measured& y) {
      const Vec3 p = x.box.lower + x.box.upper, q = y.box.lower + y.box.upper;
      return std::array{grid(p.x), grid(p.y), grid(p.z)} < std::array{grid(q.x), grid(q.y), grid(q.z)};
    });
    return all;
  };
  const auto of_a = sorted(a), of_b = sorted(b);
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_NEAR(of_a[i].volume, of_b[i].volume, relative * std::abs(of_a[i].volume)) << "component " << i;
    EXPECT_LT(max_abs(of_a[i].box.lower - of_b[i].box.lower), distance) << "component " << i;
    EXPECT_LT(max_abs(of_a[i].box.upper - of_b[i].box.upper), distance) << "component " << i;
  }
}

}  // namespace dismantle
