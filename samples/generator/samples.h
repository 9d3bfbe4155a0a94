// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/sample_model.h"

#include <string>
#include <vector>

namespace dismantle::samples {

/// The sample assemblies, modelled on the benchmarks of Du et al. 2015.
SampleModel make_microscope();
SampleModel make_tooling();
SampleModel make_lathe();
SampleModel make_robot();

/// Their names, in the paper's order.
std::vector<std::string> sample_names();
/// The sample of that name. Throws std::invalid_argument for any other name.
SampleModel make_sample(const std::string& name);

}  // namespace dismantle::samples
