// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/threemf/threemf_import.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const ThreeMfPartLoader load = [&](const std::string& part) -> Result<std::string> {
    if (part.ends_with(".rels")) return Error{ErrorKind::Unreadable, "no relationships; none"};
    return std::string(fuzz::text_of(data, size));  // every other part is the model itself
  };
  ImportOptions options;
  options.limits.components = 1000;
  fuzz::require_sound(import_3mf("input", load, options));
  return 0;
}
