// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/tool_notes.h"

#include "dismantle/fasteners/hexagon_drives.h"
#include "dismantle/fasteners/standard_sizes.h"
#include "dismantle/features/thread_axes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dismantle {

namespace {

/// Maximum sine of the angle between a motion and the axis of a drive or a thread that it uses.
constexpr double kAlong = 0.02;
/// A hexagon on a part that is not turned is no drive if the part reaches further from its axis than so many times its
/// width, or if it is wider than that of M27 [mm].
constexpr double kWidestHead = 1.5, kWidestSpanner = 41;

/// True if an axis is parallel to the direction or the axis of a leg.
bool lies_along(const Vec3& axis, const Leg& leg) {
  return length(cross(axis, leg.direction)) < kAlong;
}

Mat3 turned_mesh(const Component& component, const RemovalMove& removal) {
  return transform_from_pose(removal.poses.front()).rotation * component.assembly_from_mesh.rotation;
}

std::string thread_text(bool left_handed, const std::string& size, const std::vector<Leg>& legs,
                        PathDirection direction) {
  std::string text = std::string(left_handed ? "Left" : "Right") + "-hand thread" + size + " mm.";
  if (std::none_of(legs.begin(), legs.end(), is_screwing))
    text += direction == PathDirection::Forward ? " The rotation is not shown: unscrew first if engaged."
                                                : " The rotation is not shown: screw in.";
  return text;
}

double radius_about(const RevolutionAxis& axis, const TriangleMesh& mesh) {
  double squared = 0;
  for (const Vec3& v : mesh.vertices)
    squared = std::max(squared, length_squared(cross(axis.direction, v - axis.point)));
  return std::sqrt(squared);
}

Tool tool_for(Fastener::Drive drive, double across_flats) {
  Fastener f;
  f.drive = drive;
  f.drive_size = nominal_width(across_flats);
  return {f.drive, f.drive_size, tool_text(f)};
}

ToolNotes notes_of_shape(const TriangleMesh& mesh, const Mat3& turned, const std::vector<Leg>& legs,
                         PathDirection direction) {
  ToolNotes notes;
  const std::vector<RevolutionAxis> axes = revolution_axes(mesh.vertices, mesh.faces);
  for (const ThreadAxis& thread : thread_axes(mesh.vertices, mesh.faces, axes))
    if (lies_along(turned * thread.direction, legs.front()))
      notes.threads.push_back(thread_text(
          thread.lead < 0,
          ", diameter " + number_text(2 * thread.max_radius) + " mm, lead " + number_text(std::abs(thread.lead)), legs,
          direction));
  const bool is_turned = !notes.threads.empty() || std::any_of(legs.begin(), legs.end(), is_screwing);
  std::set<Tool> tools;
  for (const RevolutionAxis& axis : axes) {
    if (!lies_along(turned * axis.direction, legs.front())) continue;
    const double radius = radius_about(axis, mesh);
    for (const HexagonDrive& drive : hexagon_drives(mesh, axis)) {
      const double width = drive.across_flats;
      if (!is_turned && (radius > kWidestHead * width || nominal_width(width) > kWidestSpanner)) continue;
      tools.insert(tool_for(
          drive.kind == HexagonDrive::Kind::Head ? Fastener::Drive::Hexagon : Fastener::Drive::HexSocket, width));
    }
  }
  notes.tools.assign(tools.begin(), tools.end());
  return notes;
}

}  // namespace

bool is_threaded(const Fastener& f) {
  return f.kind == Fastener::Kind::Screw || f.kind == Fastener::Kind::Nut || f.kind == Fastener::Kind::Standoff;
}

bool comes_along_axis(const Component& component, const Fastener& fastener, const RemovalMove& removal,
                      const Leg& leg) {
  return lies_along(turned_mesh(component, removal) * fastener.axis, leg);
}

ToolNotes tool_notes(const Component& component, const std::optional<Fastener>& fastener, const RemovalMove& removal,
                     const std::vector<Leg>& legs, PathDirection direction) {
  if (!fastener) return notes_of_shape(*component.mesh, turned_mesh(component, removal), legs, direction);
  ToolNotes notes;
  if (!comes_along_axis(component, *fastener, removal, legs.front())) return notes;
  const std::string tool = tool_text(*fastener);
  if (!tool.empty()) notes.tools.push_back({fastener->drive, fastener->drive_size, tool});
  if (is_threaded(*fastener) && fastener->pitch > 0)
    notes.threads.push_back(thread_text(
        fastener->left_handed,
        (thread_size(fastener->diameter) != nullptr ? " M" : ", diameter ") + number_text(fastener->diameter) +
            (thread_size(fastener->diameter) != nullptr ? "" : " mm") + ", pitch " + number_text(fastener->pitch),
        legs, direction));
  return notes;
}

}  // namespace dismantle
