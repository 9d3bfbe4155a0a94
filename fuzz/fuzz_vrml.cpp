// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/read_vrml.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  ImportOptions options;
  options.limits.components = 1000;
  options.limits.triangles = 100'000;
  fuzz::require_sound(import_vrml(fuzz::source_of(data, size), options));
  return 0;
}
