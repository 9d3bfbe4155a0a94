// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace dismantle {

/// CertificateOptions::depth_tests where a person drags: about half a second a step.
inline constexpr std::size_t kSessionDepthTests = 200'000;

}  // namespace dismantle
