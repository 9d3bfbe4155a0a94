// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_ply.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  Result<MeshPart> part = parse_ply(fuzz::source_of(data, size), {});
  if (!part) {
    fuzz::require_sentence(part.error());
    return 0;
  }
  std::vector<MeshPart> parts;
  parts.push_back(std::move(*part));
  fuzz::require_sound(std::move(parts));
  return 0;
}
