// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/gltf_document.h"
#include "dismantle/formats/gltf/gltf_import.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The JSON text and the binary chunk of a glTF file.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Takes a .gltf or .glb apart; which of them it is shows in the first bytes. Errors: Unreadable.
Result<GltfContainer> open_gltf_container(std::string_view bytes, const std::string& name);

/// The bytes of a document's buffers.
struct GltfBuffers {
  std::vector<std::string_view> bytes;  ///< Of each buffer, as long as it says.
  std::deque<std::string> owned;        ///< What was decoded or loaded.
};

/// Finds the bytes of every buffer: the binary chunk, data URIs, files beside the document. Errors: Unreadable where
/// they are missing or shorter than they claim, together longer than `limit`, or elsewhere than in the file system.
Result<GltfBuffers> load_gltf_buffers(const GltfDocument& document, const GltfContainer& container,
                                      const std::string& name, const GltfFileLoader& load, std::size_t limit);

}  // namespace dismantle
