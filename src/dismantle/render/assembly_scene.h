// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

namespace dismantle {

/// How make_scene shows an assembly.
struct AssemblySceneOptions {
  double explode = 0;  ///< Each component is moved away from the middle by this times its distance from it.
  double crease_angle = kDefaultCreaseAngle;  ///< [rad]
  std::vector<Pose> poses = {};               ///< Where each component is, shape [component_count]; empty: assembled.
};

/// The assembly's components as items, in their order. Where all components have the one default colour, they get
/// colours of a palette, so that they can be told apart. Instances share their RenderMesh.
/// @pre options.poses is empty or has an entry a component
RenderScene make_scene(const Assembly& assembly, const AssemblySceneOptions& options = {});

/// The vertices of items where they are in the scene [mm, world frame], for fit_camera.
std::vector<Vec3> item_points(Span<const RenderItem> items);

/// Makes an item a ghost: grey, nearly clear, its edges faint.
void make_ghost(RenderItem& item);

/// Makes an item stand out in a colour, opaque.
void make_highlighted(RenderItem& item, const Color& color);

/// A solid arrow as an item that is drawn over everything else; its shaft has the given radius [mm].
/// @pre from != to, radius > 0
RenderItem make_arrow(Vec3 from, Vec3 to, double radius, const Color& color);

/// The same along a bent way, with its head at the end of it.
/// @pre way has two points or more, neighbours differ, radius > 0
RenderItem make_bent_arrow(Span<const Vec3> way, double radius, const Color& color);

/// The plane across the axis `direction` through `point`, taking away what is on the camera's side.
SectionPlane section_facing(const Camera& camera, Vec3 direction, Vec3 point);

}  // namespace dismantle
