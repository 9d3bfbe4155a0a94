// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle {

/// The keyframes of a glTF animation of one node, in glTF's conventions: metres, quaternions x, y, z, w.
struct GlbKeys {
  std::vector<float> times;         ///< [s], strictly ascending. Shape [key_count].
  std::vector<float> translations;  ///< [m]. Shape [key_count][3].
  std::vector<float> rotations;     ///< Neighbours in one hemisphere. Shape [key_count][4].
};

/// glTF uses metres.
inline constexpr double kMetresPerMillimetre = 1e-3;

/// The largest distance of a mesh from its position on the screw motion between two frames, as glTF interpolates
/// linearly between keys [mm].
inline constexpr double kGlbDeviation = 1e-3;

/// The keyframes that move a component's node through frames. Each frame gives a key, except frames in the middle of a
/// rest and repeated frames at one time; its numbers are the nearest floats (relative error at most 2^-24). Where a
/// screw motion deviates from linear interpolation by more than kGlbDeviation, or turns far, keys are added in between.
/// A time that float cannot distinguish from the one before becomes the next float.
/// @pre frames not empty, their times not descending
GlbKeys glb_keys(const RigidTransform& assembly_from_mesh, Span<const Frame> frames);

}  // namespace dismantle
