// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/puzzle_scenes.h"
#include "tests/support/slide_scenes.h"
#include "tests/support/swept_meshes.h"

/// What the tests of the engine and of its queries share.
namespace dismantle::grabbed {

inline constexpr double kTolerance = 0.01;

inline PairStates states_of(const Assembly& assembly) {
  ClassifyOptions classify;
  classify.tolerance = kTolerance;
  return *classify_pairs(assembly, classify);
}

/// An engine with one moving component.
struct Grabbed {
  Grabbed(const Assembly& assembly, const PairStates& states, std::uint32_t component,
          const CertificateOptions& options = {})
      : engine(assembly, states, options) {
    const ComponentId id(component);
    engine.grab({&id, 1});
  }
  CertificateEngine engine;
};

inline Assembly block_and_floor() {
  return scenes::assembly({scenes::component("block", scenes::box({0, 0, 1}, {10, 10, 11})),
                           scenes::component("floor", scenes::box({-50, -50, -5}, {50, 50, 0}))});
}

/// A rod with a head, through a flange that has no hole for it, on a block. Rod and flange are so thin that depth does
/// not keep them where they are; the head and the block are not.
inline Assembly rod_through_flange() {
  const TriangleMesh rod = scenes::box_block({{{-7, -5.4, -4.6, -3}, {-3, 5, 9}, {-2, -0.4, 0.4, 2}}},
                                             [](int i, int j, int k) { return j == 1 || (i == 1 && k == 1); });
  const TriangleMesh flange =
      scenes::box_block({{{-10, 0, 10}, {0, 1, 10}, {-5, 5}}}, [](int i, int j, int) { return i == 1 || j == 0; });
  return scenes::assembly({scenes::component("rod", rod), scenes::component("flange", flange)});
}

}  // namespace dismantle::grabbed
