// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/math/rigid_transform.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// The animation of one component: one screw motion from frame to frame. It rests at the first frame before, and at the
/// last frame afterwards.
struct GlbTrack {
  ComponentId component;      ///< The component that moves.
  std::vector<Frame> frames;  ///< Not empty; times [s] from 0, not descending.
};

/// An animation. Components without a track stay at their pose in GlbOptions::poses.
struct GlbAnimation {
  std::string name;              ///< Shown by viewers.
  std::vector<GlbTrack> tracks;  ///< At most one for each component.
};

/// Options of glb_from_assembly.
struct GlbOptions {
  std::vector<Pose> poses;               ///< Pose of each component, shape [component_count]; empty: assembled.
  std::vector<GlbAnimation> animations;  ///< In the order in which viewers list them.
  ProgressCallback progress;             ///< May be empty.
};

/// The assembly as binary glTF 2.0, in metres, axes unchanged: the product tree as nodes, one node for each component
/// with its name, its placement and, under `extras`, `component`: its exact name again (tools rename nodes), and
/// `index`: its index. Components that share a mesh share its bytes; triangles keep their order. Positions are float32
/// in the component's own frame: relative error at most 2^-24 (60 nm in a metre). No normals: viewers shade flat.
/// Animations move nodes with the keys of glb_keys; equal keys are shared, and an animation in which nothing moves is
/// left out. Errors: Failed if it would be longer than 4 GiB, or was cancelled.
/// @pre options.poses is empty or has an entry for each component
Result<std::string> glb_from_assembly(const Assembly& assembly, const GlbOptions& options = {});

/// Writes glb_from_assembly to a file, whole or not at all. Errors: Failed.
Result<Done> write_glb(const Assembly& assembly, const std::filesystem::path& file, const GlbOptions& options = {});

}  // namespace dismantle
