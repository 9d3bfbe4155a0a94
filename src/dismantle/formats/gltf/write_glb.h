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

/// The way of a component in an animation: by the one screw motion from frame to frame; before the first frame it is
/// there, after the last one, too.
struct GlbTrack {
  ComponentId component;
  std::vector<Frame> frames;  ///< Not empty; times [s] from 0 on, not descending.
};

/// An animation: what it does not name stays where GlbOptions::poses has it.
struct GlbAnimation {
  std::string name;
  std::vector<GlbTrack> tracks;  ///< At most one a component.
};

struct GlbOptions {
  std::vector<Pose> poses;  ///< Where each component is now, shape [component_count]; empty: assembled.
  std::vector<GlbAnimation> animations;
  ProgressCallback progress;
};

/// An assembly as binary glTF 2.0, in metres, axes as they are: the product tree as nodes, one node a component with
/// its name, its placement and, under `extras`, `component`: its exact name once more (tools rename nodes), and
/// `index`: which component it is. Components that share a mesh share its bytes; triangles keep their order. Positions
/// are float32 in the component's own frame: off by at most 2^-24 of their coordinate (60 nm in a metre). No normals:
/// viewers shade flat. Animations move nodes, with keys as of glb_keys; equal keys are shared, and an animation in
/// which nothing leaves its place is left out. Errors: Failed where it would be longer than 4 GiB, or was cancelled.
/// @pre options.poses is empty or has an entry a component
Result<std::string> glb_from_assembly(const Assembly& assembly, const GlbOptions& options = {});

/// Writes glb_from_assembly to a file, whole or not at all. Errors: Failed.
Result<Done> write_glb(const Assembly& assembly, const std::filesystem::path& file, const GlbOptions& options = {});

}  // namespace dismantle
