// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"

namespace dismantle {

/// Bounds the work of a step where a person drags: a few tenths of a second where depths are hard to bound, some
/// milliseconds where a set slides along contacts. What is left is done by the next step.
inline void limit_steps(CertificateOptions& options) {
  options.depth_tests = 200'000;
  options.slide_tests = 400;
}

}  // namespace dismantle
