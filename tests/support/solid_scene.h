// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_tree.h"
#include "tests/support/meshes.h"

#include <utility>

namespace dismantle::scenes {

/// A mesh with the tree that method `certificates` works on.
struct Solid {
  Assembly assembly;
  SolidTree tree;
  explicit Solid(TriangleMesh mesh)
      : assembly(scenes::assembly({component("solid", std::move(mesh))})),
        tree(make_solid_tree(assembly.components[0], {})) {}
};

}  // namespace dismantle::scenes
