// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_import.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  // A file beside the input: its own bytes, so that the fuzzer can fill external buffers too.
  const auto load = [=](const std::string&, std::size_t limit) -> Result<std::string> {
    if (size > limit) return Error{ErrorKind::Unreadable, "too large"};
    return std::string(fuzz::text_of(data, size));
  };
  ImportOptions options;
  options.limits.triangles = 100'000;
  options.limits.file_bytes = 1 << 20;
  fuzz::require_sound(import_gltf(fuzz::text_of(data, size), "input", load, options));
  return 0;
}
