// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/files/text_name.h"

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The bytes of a file that a parser reads, and what to call it in messages.
struct MeshSource {
  std::string_view bytes;
  std::string name;  ///< File name without its folder.
};

/// One mesh as a file gives it: in the file's units, not welded, not cleaned; every index is below the vertex count.
struct MeshPart {
  std::string name;  ///< Empty where the file gives none.
  TriangleMesh mesh;
  Color color;
  std::string material;  ///< OBJ: the material's name, to be looked up; else empty.
};

/// The Error of a file that is not what its format wants: `why` names the place.
inline Error malformed(const MeshSource& source, std::string_view format, std::string_view why) {
  return {ErrorKind::Unreadable,
          source.name + " cannot be read as " + std::string(format) + " (" + std::string(why) + "); export it again"};
}

/// The Error of work that its progress callback called off.
inline Error cancelled() {
  return {ErrorKind::Failed, "cancelled"};
}

}  // namespace dismantle
