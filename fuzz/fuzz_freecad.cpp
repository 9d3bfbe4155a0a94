// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/freecad/freecad_scene.h"
#include "fuzz/fuzz_input.h"

namespace dismantle {

namespace {

void require_sound(const FreeCadScene& result) {
  const std::vector<SceneNode>& nodes = result.scene.nodes;
  for (const std::size_t root : result.scene.roots) fuzz::require(root < nodes.size(), "a root");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    fuzz::require(!nodes[i].mesh || *nodes[i].mesh < result.shapes.size(), "a shape");
    // Children are made before what holds them: no node is its own ancestor.
    for (const std::size_t child : nodes[i].children) fuzz::require(child < i, "an earlier child");
  }
  for (const FreeCadShape& shape : result.shapes) fuzz::require(!shape.entry.empty(), "the name of a shape's file");
}

}  // namespace

}  // namespace dismantle

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const std::string text(fuzz::text_of(data, size));
  const FreeCadEntryReader read = [&](const std::filesystem::path& file, const std::string&) {
    if (file.native().size() > 200) return Result<std::string>(Error{ErrorKind::Unreadable, "no such file; none"});
    return Result<std::string>(text);  // every document is this one, every list of numbers its bytes
  };
  const Result<FreeCadScene> scene = read_freecad_scene("folder/input.FCStd", read);
  if (!scene) {
    fuzz::require_sentence(scene.error());
  } else {
    require_sound(*scene);
  }
  return 0;
}
