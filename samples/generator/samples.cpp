// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/samples.h"

#include <stdexcept>

namespace dismantle::samples {

std::vector<std::string> sample_names() {
  return {"microscope", "tooling", "lathe", "robot"};
}

SampleModel make_sample(const std::string& name) {
  if (name == "microscope") return make_microscope();
  if (name == "tooling") return make_tooling();
  if (name == "robot") return make_robot();
  if (name == "lathe") return make_lathe();
  throw std::invalid_argument("there is no sample named " + name);
}

}  // namespace dismantle::samples
