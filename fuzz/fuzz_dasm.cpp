// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_file.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const Result<AssemblyFile> file = parse_assembly_file({reinterpret_cast<const std::byte*>(data), size}, "fuzz.dasm");
  if (!file) return 0;
  for (const Component& component : file->assembly.components)
    for (const Face& f : component.mesh->faces)
      for (const std::uint32_t v : f.v) fuzz::require(v < component.mesh->vertices.size(), "indices below the count");
  if (file->motion)
    for (const MotionMove& move : file->motion->moves)
      for (const std::string& name : move.components)
        fuzz::require(file->assembly.find(name).has_value(), "a motion of its own components");
  const std::string written = assembly_file_bytes(file->assembly, file->motion ? &*file->motion : nullptr);
  const Result<AssemblyFile> again =
      parse_assembly_file({reinterpret_cast<const std::byte*>(written.data()), written.size()}, "again.dasm");
  fuzz::require(again.ok() && again->motion == file->motion, "what was read is written and read back the same");
  return 0;
}
