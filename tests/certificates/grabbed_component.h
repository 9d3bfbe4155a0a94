// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
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

}  // namespace dismantle::grabbed
