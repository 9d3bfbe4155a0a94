// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_stl.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  fuzz::require_sound(parse_stl(fuzz::source_of(data, size), {}));
  return 0;
}
