// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dismantle {

/// The transform from the world to the screen. The view frame has x to the right, y up and z as depth ahead of the eye
/// [mm]; screen coordinates are in samples, y down. The depth *key* increases with depth and is linear on the screen:
/// the depth itself for an orthographic camera, -1/depth for a perspective one.
struct ViewTransform {
  Mat3 axes;                 ///< Rotation, view from world.
  Vec3 eye;                  ///< [mm], world frame.
  bool perspective = false;  ///< Perspective instead of orthographic projection.
  double scale = 1;          ///< Samples per mm (orthographic), or per unit of x/depth (perspective).
  double center_x = 0;       ///< Screen position of the optical axis [samples].
  double center_y = 0;       ///< Screen position of the optical axis [samples].
  double near_depth = 0;     ///< Perspective: depth of the near plane [mm].

  /// A point in the view frame [mm].
  Vec3 to_view(Vec3 world) const { return axes * (world - eye); }
  /// The depth [mm] of a depth key.
  double depth_of_key(double key) const { return perspective ? -1 / key : key; }
  /// The depth key of a depth [mm].
  double key_of_depth(double depth) const { return perspective ? -1 / depth : depth; }
};

/// A clipping plane in the view frame; keeps dot(normal, x) <= offset.
struct ViewPlane {
  Vec3 normal;        ///< Points to the side that is removed.
  double offset = 0;  ///< [mm] if the normal has unit length.
};

/// A projected triangle.
struct ScreenTriangle {
  float x[3];                ///< Of the corners [samples].
  float y[3];                ///< Of the corners [samples].
  float key[3];              ///< Depth keys of the corners.
  float weight[3];           ///< 1/depth (perspective) or 1, for perspective-correct interpolation.
  Vec3f normal[3];           ///< View frame, not flipped towards the eye.
  std::uint32_t item = 0;    ///< Index into the scene's items.
  std::uint32_t face = 0;    ///< Index into the faces of the item's mesh.
  bool back_facing = false;  ///< Seen from the inside.
};

/// A projected line.
struct ScreenLine {
  float x[2];                       ///< Of the ends [samples].
  float y[2];                       ///< Of the ends [samples].
  float key[2];                     ///< Depth keys of the ends.
  float half_width = 1;             ///< [samples]
  Color color;                      ///< `a` is the opacity.
  std::uint32_t item = 0;           ///< Feature edge: index into the scene's items.
  std::uint32_t faces[2] = {0, 0};  ///< Feature edge: its adjacent faces, which do not hide it.
  bool is_edge = false;             ///< A feature edge of an item.
};

/// The pass in which a triangle or line is drawn.
enum class Layer { Opaque, Transparent, Overlay, Overlap };
/// Number of layers.
inline constexpr std::size_t kLayerCount = 4;

/// A scene projected onto the screen.
struct ProjectedScene {
  ViewTransform view;                                              ///< Maps the world to the screen.
  std::optional<ViewPlane> section;                                ///< The scene's section plane.
  double size = 1;                                                 ///< Diagonal of the bounding box of the scene [mm].
  std::array<std::vector<ScreenTriangle>, kLayerCount> triangles;  ///< By layer, ordered by item and face.
  std::array<std::vector<ScreenLine>, kLayerCount> lines;          ///< By layer; none in Overlap.
};

/// Transforms, clips (near plane, section plane, screen borders) and projects a scene.
ProjectedScene project_scene(const RenderScene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace dismantle
