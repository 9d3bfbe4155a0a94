// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "python/src/bind.h"

namespace dismantle::python {

using PathHolder = std::shared_ptr<Path>;

inline PathHolder hold_path(Path path) {
  return std::make_shared<Path>(std::move(path));
}

}  // namespace dismantle::python
