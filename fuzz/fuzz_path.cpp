// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const Result<Path> path = parse_path(fuzz::text_of(data, size), "input");
  if (!path) {
    fuzz::require_sentence(path.error());
    return 0;
  }
  const Result<Path> again = parse_path(path_text(*path), "again");
  fuzz::require(again.ok() && *again == *path, "what was read is written and read back equal");
  return 0;
}
