// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_obj.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  Result<ObjModel> model = parse_obj(fuzz::source_of(data, size), {});
  if (model) {
    fuzz::require_sound(std::move(model->parts));
  } else {
    fuzz::require_sentence(model.error());
  }
  parse_mtl(fuzz::text_of(data, size));
  return 0;
}
