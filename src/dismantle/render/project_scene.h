// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dismantle {

/// From world to picture. The view frame has x to the right, y up and z the depth ahead of the eye [mm]; the screen is
/// measured in samples, y down. Along the screen a *key* grows with depth and is linear: the depth itself for an
/// orthographic camera, -1/depth for a perspective one.
struct ViewTransform {
  Mat3 axes;  ///< View from world.
  Vec3 eye;   ///< [mm]
  bool perspective = false;
  double scale = 1;     ///< Samples per mm (orthographic), or per unit of x/depth (perspective).
  double center_x = 0;  ///< [samples]
  double center_y = 0;
  double near_depth = 0;  ///< Perspective: what is nearer than this is cut off [mm].

  Vec3 to_view(Vec3 world) const { return axes * (world - eye); }
  double depth_of_key(double key) const { return perspective ? -1 / key : key; }
  double key_of_depth(double depth) const { return perspective ? -1 / depth : depth; }
};

/// A plane in the view frame; kept is dot(normal, x) <= offset.
struct ViewPlane {
  Vec3 normal;
  double offset = 0;
};

/// A triangle on the screen. Normals are in the view frame, not turned towards the eye.
struct ScreenTriangle {
  float x[3], y[3], key[3];
  float weight[3];  ///< 1/depth (perspective) or 1: divides linear screen interpolation back to the surface.
  Vec3f normal[3];
  std::uint32_t item = 0, face = 0;
  bool back_facing = false;
};

/// A line on the screen.
struct ScreenLine {
  float x[2], y[2], key[2];
  float half_width = 1;  ///< [samples]
  Color color;
  std::uint32_t item = 0, faces[2] = {0, 0};  ///< The item's triangles that must not hide the line, if it is an edge.
  bool is_edge = false;
};

/// What a triangle or line takes part in; drawn in this order.
enum class Layer { Opaque, Transparent, Overlay, Overlap };
inline constexpr std::size_t kLayerCount = 4;

/// The scene on the screen.
struct ProjectedScene {
  ViewTransform view;
  std::optional<ViewPlane> section;
  double size = 1;  ///< Diagonal of everything shown [mm].
  std::array<std::vector<ScreenTriangle>, kLayerCount> triangles;
  std::array<std::vector<ScreenLine>, kLayerCount> lines;  ///< None in Overlap.
};

/// Transforms, clips (near plane, section plane, border of the picture) and projects. Keeps the order of items and
/// faces.
ProjectedScene project_scene(const RenderScene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace dismantle
