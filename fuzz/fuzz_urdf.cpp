// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/read_urdf.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const MeshLoader one_triangle = [](const std::string& address) -> Result<std::vector<MeshPart>> {
    if (address.empty()) return Error{ErrorKind::Unreadable, "no mesh"};
    MeshPart part;
    part.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}};
    return std::vector<MeshPart>{part};
  };
  ImportOptions options;
  for (const Solids visuals : {Solids::Split, Solids::Join}) {
    options.solids = visuals;
    fuzz::require_sound(parse_urdf(fuzz::source_of(data, size), options, one_triangle));
  }
  return 0;
}
