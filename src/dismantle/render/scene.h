// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/exec/executor.h"
#include "dismantle/math/rigid_transform.h"
#include "dismantle/render/render_mesh.h"

#include <memory>
#include <optional>
#include <vector>

namespace dismantle {

/// One mesh instance of a scene.
struct RenderItem {
  std::shared_ptr<const RenderMesh> mesh;  ///< Never null.
  RigidTransform world_from_mesh;          ///< Pose of the mesh.
  Color color;                             ///< Transparent if `a` is below 1.
  float edge_opacity = 0.85f;              ///< Opacity of feature edges; 0 for none.
  bool closed = false;   ///< Closed, normals outward: sections are capped; no far side if transparent.
  bool overlay = false;  ///< Drawn on top; hidden only by other overlays.
  bool section = true;   ///< Cut by the scene's section plane.
};

/// A line of constant screen width.
struct RenderLine {
  Vec3 ends[2];          ///< [mm]
  Color color;           ///< `a` is the opacity.
  float width = 1.5f;    ///< [pixels]
  bool overlay = false;  ///< Drawn on top of everything.
};

/// A section plane: removes the points with dot(normal, x) > offset. World frame.
struct SectionPlane {
  Vec3 normal{1, 0, 0};  ///< Unit length.
  double offset = 0;     ///< [mm]
  bool cap = true;       ///< Fill the cut surfaces of closed items.
};

/// Marks the common volume of two closed items, drawn on top of everything.
struct OverlapMark {
  std::size_t items[2] = {0, 0};          ///< Indices into RenderScene::items.
  Color color{0.9f, 0.05f, 0.05f, 0.8f};  ///< `a` is the opacity.
};

/// The contents of a picture.
struct RenderScene {
  std::vector<RenderItem> items;        ///< Bodies.
  std::vector<RenderLine> lines;        ///< Lines besides feature edges; not cut by the section plane.
  std::optional<SectionPlane> section;  ///< Cuts the items whose `section` is set.
  std::optional<OverlapMark> overlap;   ///< Highlighted common volume.
};

/// Image size, quality and style of render().
struct RenderOptions {
  int width = 800;                            ///< [pixels]
  int height = 600;                           ///< [pixels]
  int samples = 3;                            ///< Samples along each side of a pixel: 3 means 9 per pixel.
  Color background_top{0.93f, 0.95f, 0.97f};  ///< Start of the background's vertical gradient.
  Color background_bottom{1.0f, 1.0f, 1.0f};  ///< End of the background's vertical gradient.
  Color edge_color{0.07f, 0.08f, 0.10f};      ///< Feature edges and outlines.
  float edge_width = 1.1f;                    ///< [pixels]
  int transparent_layers = 4;                 ///< Maximum depth of transparent surfaces that are blended.
  Executor executor;                          ///< Runs items and tiles in parallel.
};

}  // namespace dismantle
