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
  std::string_view json;                   ///< The JSON part.
  std::optional<std::string_view> binary;  ///< The binary chunk of a GLB.
};

/// Splits a .gltf or .glb file into its parts; the first bytes tell which it is. Errors: Unreadable.
Result<GltfContainer> open_gltf_container(std::string_view bytes, const std::string& name);

/// The bytes of a document's buffers.
struct GltfBuffers {
  std::vector<std::string_view> bytes;  ///< Of each buffer, of the length that the document gives.
  std::deque<std::string> owned;        ///< Storage of decoded and loaded bytes.
};

/// Resolves the bytes of every buffer: the binary chunk, data URIs, files beside the document. Errors: Unreadable if
/// they are missing, shorter than declared, together longer than `limit` [bytes], or not in the file system.
Result<GltfBuffers> load_gltf_buffers(const GltfDocument& document, const GltfContainer& container,
                                      const std::string& name, const GltfFileLoader& load, std::size_t limit);

}  // namespace dismantle
