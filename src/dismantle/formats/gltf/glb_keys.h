// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle {

/// The keys of a glTF animation of one node, as glTF has them: metres, quaternions x, y, z, w.
struct GlbKeys {
  std::vector<float> times;         ///< [s], strictly ascending. Shape [key_count].
  std::vector<float> translations;  ///< [m]. Shape [key_count][3].
  std::vector<float> rotations;     ///< Neighbours on one side of the 3-sphere. Shape [key_count][4].
};

/// glTF has metres.
inline constexpr double kMetresPerMillimetre = 1e-3;

/// How far a mesh may be from where the screw between two frames has it, while glTF goes straight between keys [mm].
inline constexpr double kGlbDeviation = 1e-3;

/// The keys that lead a component's node through frames. Each frame has a key, but for frames in the middle of a rest
/// and for equal ones at one time; its numbers are the floats nearest to the frame's own (off by at most 2^-24 of
/// themselves). Where a screw bends away from the straight way by more than kGlbDeviation, or turns far, it gets keys
/// in between. A time that a float cannot tell from the one before is the next float.
/// @pre frames not empty, their times not descending
GlbKeys glb_keys(const RigidTransform& assembly_from_mesh, Span<const Frame> frames);

}  // namespace dismantle
