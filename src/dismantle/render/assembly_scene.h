// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/render/camera.h"
#include "dismantle/render/scene.h"

namespace dismantle {

/// Options of make_scene().
struct AssemblySceneOptions {
  double explode = 0;  ///< Displacement of each component from the centre, as a multiple of its distance from it.
  double crease_angle = kDefaultCreaseAngle;  ///< Passed to make_render_mesh() [rad].
  std::vector<Pose> poses = {};  ///< Pose of each component, shape [component_count]; empty: assembled state.
};

/// The components of an assembly as render items, in their order. If every component has the default colour, colours of
/// a palette are used instead. Instances share one RenderMesh.
/// @pre options.poses is empty or has one entry per component
RenderScene make_scene(const Assembly& assembly, const AssemblySceneOptions& options = {});

/// All vertices of the items, for fit_camera() [mm, world frame].
std::vector<Vec3> item_points(Span<const RenderItem> items);

/// Turns an item into a ghost: grey and nearly transparent, with faint edges.
void make_ghost(RenderItem& item);

/// Highlights an item: opaque, in the given colour.
void make_highlighted(RenderItem& item, const Color& color);

/// A straight solid arrow, drawn as an overlay. @param radius of the shaft [mm]
/// @pre from != to, radius > 0
RenderItem make_arrow(Vec3 from, Vec3 to, double radius, const Color& color);

/// A curved solid arrow along a polyline, with its head at the last point; otherwise as make_arrow().
/// @pre at least two points, successive points differ, radius > 0
RenderItem make_curved_arrow(Span<const Vec3> points, double radius, const Color& color);

/// The section plane through `point` with normal `direction`, oriented to remove the camera's side.
SectionPlane section_facing(const Camera& camera, Vec3 direction, Vec3 point);

}  // namespace dismantle
