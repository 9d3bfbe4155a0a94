// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/files/text_name.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The bytes of a file for a parser, and its name for messages.
struct MeshSource {
  std::string_view bytes;  ///< The whole file.
  std::string name;        ///< File name without its folder.
};

/// A mesh as a file gives it: in the file's units, not welded or cleaned; every index is below the vertex count.
struct MeshPart {
  std::string name;      ///< Empty if the file gives none.
  TriangleMesh mesh;     ///< In the file's units.
  Color color;           ///< Of the whole part.
  std::string material;  ///< OBJ: the name of its material; else empty.
};

/// The Error for a file that violates its format; `why` says where and how.
inline Error malformed(const MeshSource& source, std::string_view format, std::string_view why) {
  return {ErrorKind::Unreadable,
          source.name + " cannot be read as " + std::string(format) + " (" + std::string(why) + "); export it again"};
}

/// The Error for work that its progress callback cancelled.
inline Error cancelled() {
  return {ErrorKind::Failed, "cancelled"};
}

}  // namespace dismantle
