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

/// One body in a picture.
struct RenderItem {
  std::shared_ptr<const RenderMesh> mesh;  ///< Never null.
  RigidTransform world_from_mesh;
  Color color;                 ///< Below 1 in `a` it is transparent: what is behind shines through.
  float edge_opacity = 0.85f;  ///< How strongly its feature edges are drawn; 0 for none.
  bool closed = false;         ///< A closed surface with normals out: its section is capped, its far side is not seen.
  bool overlay = false;        ///< Drawn over everything else, hidden by nothing but other overlays.
  bool section = true;         ///< Cut by the scene's section plane.
};

/// A line of constant width in the picture.
struct RenderLine {
  Vec3 ends[2];  ///< [mm]
  Color color;
  float width = 1.5f;    ///< [pixels]
  bool overlay = false;  ///< Hidden by nothing.
};

/// Takes away what lies beyond a plane: points with dot(normal, x) > offset.
struct SectionPlane {
  Vec3 normal{1, 0, 0};  ///< Unit length.
  double offset = 0;     ///< [mm]
  bool cap = true;       ///< Fill the cut of closed items.
};

/// Two items whose common volume is marked, drawn over everything else. Both must be closed.
struct OverlapMark {
  std::size_t items[2] = {0, 0};
  Color color{0.9f, 0.05f, 0.05f, 0.8f};
};

/// Everything that a picture shows.
struct RenderScene {
  std::vector<RenderItem> items;
  std::vector<RenderLine> lines;
  std::optional<SectionPlane> section;
  std::optional<OverlapMark> overlap;
};

/// How a picture is made.
struct RenderOptions {
  int width = 800;                            ///< [pixels]
  int height = 600;                           ///< [pixels]
  int samples = 3;                            ///< Samples along a pixel's side: 3 means 9 a pixel.
  Color background_top{0.93f, 0.95f, 0.97f};  ///< The background runs from here ...
  Color background_bottom{1.0f, 1.0f, 1.0f};  ///< ... to here.
  Color edge_color{0.07f, 0.08f, 0.10f};
  float edge_width = 1.1f;     ///< [pixels]
  int transparent_layers = 4;  ///< Transparent surfaces kept one behind another.
  Executor executor;
};

}  // namespace dismantle
