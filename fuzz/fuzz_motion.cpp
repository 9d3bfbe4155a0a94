// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const Result<Motion> motion = parse_motion(fuzz::text_of(data, size), "input");
  if (!motion) {
    fuzz::require_sentence(motion.error());
    return 0;
  }
  const Result<Motion> again = parse_motion(motion_text(*motion), "again");
  fuzz::require(again.ok() && *again == *motion, "what was read is written and read back equal");
  return 0;
}
