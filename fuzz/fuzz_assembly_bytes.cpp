// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_bytes.h"
#include "fuzz/fuzz_input.h"

namespace {

std::vector<std::byte> bytes_of(const dismantle::Assembly& assembly) {
  std::vector<std::byte> bytes;
  dismantle::write_assembly_bytes(assembly, [&bytes](const void* data, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
  });
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const auto assembly = assembly_from_bytes({reinterpret_cast<const std::byte*>(data), size});
  if (!assembly) return 0;
  for (const Component& component : assembly->components) {
    fuzz::require(component.tree_node < assembly->tree.size(), "a place in the tree");
    for (const Face& f : component.mesh->faces)
      for (const std::uint32_t v : f.v) fuzz::require(v < component.mesh->vertices.size(), "indices below the count");
  }
  const std::vector<std::byte> written = bytes_of(*assembly);
  const auto again = assembly_from_bytes(Span<const std::byte>(written));
  fuzz::require(again && bytes_of(*again) == written, "what was read is written and read back the same");
  return 0;
}
