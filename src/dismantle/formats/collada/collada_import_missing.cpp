// SPDX-License-Identifier: Apache-2.0
// In place of collada_import.cpp where there is no Assimp.
#include "dismantle/formats/collada/collada_import.h"

namespace dismantle {

Result<Assembly> import_collada(std::string_view, const std::string&, const ImportOptions&) {
  return Error{ErrorKind::Unreadable,
               "this dismantle was built without Assimp; build it where libassimp-dev is installed, or convert the "
               "file to glTF, or to OBJ for a URDF"};
}

}  // namespace dismantle
