// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "tests/support/meshes.h"
#include "tests/support/timeline_of_path.h"

namespace dismantle::scenes {

/// A lid on a base, with two equal hexagon heads of 7 mm on it:
///
///       [bolt]   [bolt#2]
///     ========== lid ==========
///     |        base       |
///
/// Both heads move up, then the lid.
inline Assembly bolted_lid() {
  TriangleMesh head = tube(7 / std::sqrt(3), 0, 5, 9, 6);
  Assembly a =
      assembly({component("base", box({-40, -40, -30}, {40, 40, 0})), component("lid", box({-40, -40, 0}, {60, 40, 5})),
                component("bolt", head), component("bolt#2", head)});
  a.components[3].mesh = a.components[2].mesh;
  a.components[2].assembly_from_mesh.translation = {-20, 0, 0};
  a.components[3].assembly_from_mesh.translation = {20, 0, 0};
  a.source_file = "lid <of> & \"box\".step";
  a.source_sha256 = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";
  return a;
}

inline Path bolted_lid_path() {
  Path path;
  path.components = {"base", "lid", "bolt", "bolt#2"};
  const auto up = [](double height) { return std::vector<Frame>{{0, {}}, {1, {{0, 0, height}, {}}}}; };
  path.moves = {
      {"remove bolt", {"bolt"}, up(60)}, {"remove bolt#2", {"bolt#2"}, up(75)}, {"remove lid", {"lid"}, up(30)}};
  return path;
}

inline PairStates bolted_lid_pairs() {
  const auto contact = [](std::uint32_t a, std::uint32_t b) {
    return ComponentPair{ComponentId(a), ComponentId(b), PairState::Contact, 0, 0, 0.01};
  };
  return {0.01, {contact(0, 1), contact(1, 2), contact(1, 3)}};
}

}  // namespace dismantle::scenes
