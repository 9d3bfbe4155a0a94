// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// A sample assembly that the program carries in itself, so that it needs no installed files.
struct BundledSample {
  std::string_view name;
  std::string_view description;  ///< One line for a list.
};

/// In the order of the paper's benchmarks.
std::vector<BundledSample> bundled_samples();

/// The sample's STEP file. Errors: Usage where there is no sample of that name, listing those there are.
Result<std::string> bundled_sample_step(std::string_view name);

/// The sample's motion file (docs/formats.md, `*.motion.json`). Errors: as bundled_sample_step.
Result<std::string> bundled_sample_motion(std::string_view name);

}  // namespace dismantle
