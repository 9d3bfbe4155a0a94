// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "python/src/bind.h"

namespace dismantle::python {

/// Shared with Python.
using PathHolder = std::shared_ptr<Path>;

/// Moves a path to the heap.
inline PathHolder shared_path(Path path) {
  return std::make_shared<Path>(std::move(path));
}

}  // namespace dismantle::python
