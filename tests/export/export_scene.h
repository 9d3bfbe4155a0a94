// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/meshes.h"
#include "tests/support/timeline_of_path.h"

namespace dismantle::scenes {

/// A block on a plate, and a knob on the block: the knob is unscrewed and put aside, then the block.
inline Assembly knob_on_block() {
  Assembly a =
      assembly({component("plate", box({-50, -50, -5}, {50, 50, 0})),
                component("block", box({-10, -10, 0}, {10, 10, 20})), component("knob", tube(4, 0, 0, 8, 24))});
  a.components[2].assembly_from_mesh = transform_from_pose({{3, 0, 20}, quat_about({0, 0, 1}, 0.3)});
  return a;
}

inline Path knob_path() {
  const Pose turned{{0, 0, 6}, quat_about({0, 0, 1}, 2.5)}, off{{0, 0, 30}, turned.rotation};
  const Pose aside = Pose{{80, 0, 0}, {}} * off;
  Path path;
  path.components = {"plate", "block", "knob"};
  path.moves = {{"screw off knob", {"knob"}, {{0, {}}, {0.5, turned}, {0.75, off}}},
                {"knob aside", {"knob"}, {{0, off}, {1, aside}}},
                {"block aside", {"block"}, {{0, {}}, {2, {{0, 60, 0}, {}}}}}};
  return path;
}

}  // namespace dismantle::scenes
