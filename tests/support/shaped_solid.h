// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"
#include "tests/support/random_scenes.h"

#include <utility>

namespace dismantle::scenes {

/// A component of one mesh and its shape.
struct ShapedSolid {
  Component component;
  SolidShape shape{component};
  explicit ShapedSolid(TriangleMesh mesh) : component(scenes::component("solid", std::move(mesh))) {}
};

}  // namespace dismantle::scenes
