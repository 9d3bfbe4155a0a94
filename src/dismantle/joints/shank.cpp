// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/shank.h"

#include "dismantle/joints/axial_rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dismantle {

namespace {

/// Distance of planes, in nominal diameters of the thread, and their fewest and largest number.
constexpr double kStep = 0.1;
constexpr double kMinPlanes = 24, kMaxPlanes = 240;
/// A radius is that of the thread up to this many times the thread's: chamfers, models at the root or over the crests.
constexpr double kThreadShare = 1.15;
/// Where the radius of the thread is measured, as a share of the length from the tip.
constexpr double kMeasuredAt = 0.25;
/// The head begins where the radius has grown by this share from that of the thread to the largest. Shoulders, and the
/// narrow part of a countersunk head's cone, belong to the shank.
constexpr double kHeadShare = 0.6;

double mean(const double* begin, const double* end) {
  return begin == end ? 0 : std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

Shank cut_along(const Component& component, const Vec3& point, const Vec3& axis, double diameter) {
  Shank shank;
  shank.frame = AxisFrame(point, axis);
  double begin = INFINITY, end = -INFINITY;
  for (const Vec3& v : assembled_vertices(component)) {
    begin = std::min(begin, shank.frame.along(v));
    end = std::max(end, shank.frame.along(v));
  }
  const double wanted = diameter > 0 ? (end - begin) / (kStep * diameter) : kMinPlanes;
  const double count = std::clamp(std::ceil(wanted), kMinPlanes, kMaxPlanes);
  shank.step = (end - begin) / count;
  for (double k = -0.5; k < count; k += 1) shank.positions.push_back(begin + k * shank.step);
  const AxialRays own(component, shank.frame, shank.positions);
  for (std::size_t k = 0; k < shank.positions.size(); ++k) shank.radii.push_back(own.outer(k));
  return shank;
}

/// True if a standoff's thin end, a stud, is where positions are largest.
bool stud_is_at_end(const Shank& cut, double thread_radius) {
  const std::size_t tenth = cut.radii.size() / 10;
  return cut.radii[cut.radii.size() - 1 - tenth] <= kThreadShare * thread_radius;
}

bool is_turned_over(const Shank& cut, const Fastener& f) {
  if (f.kind == Fastener::Kind::Standoff) return stud_is_at_end(cut, f.diameter / 2);
  // The axis of what only its name tells is of either sign.
  const double* middle = cut.radii.data() + cut.radii.size() / 2;
  const double near_tip = mean(cut.radii.data() + 1, middle);
  const double near_head = mean(middle, cut.radii.data() + cut.radii.size());
  return f.by_name_only && near_tip > kThreadShare * near_head;
}

}  // namespace

std::optional<Shank> shank_of(const Component& component, const Fastener& f) {
  if (f.kind != Fastener::Kind::Screw && f.kind != Fastener::Kind::Standoff) return std::nullopt;
  const Vec3 point = component.assembly_from_mesh * f.point;
  const Vec3 axis = component.assembly_from_mesh.rotation * f.axis;
  Shank shank = cut_along(component, point, axis, f.diameter);
  if (is_turned_over(shank, f)) shank = cut_along(component, point, -axis, f.diameter);

  const auto at = static_cast<std::size_t>(kMeasuredAt * static_cast<double>(shank.radii.size()));
  shank.thread_radius = f.diameter > 0 ? f.diameter / 2 : shank.radii[std::max<std::size_t>(1, at)];
  shank.head_radius = *std::max_element(shank.radii.begin(), shank.radii.end());
  shank.has_head = shank.head_radius > kThreadShare * shank.thread_radius;
  const double limit =
      shank.has_head ? shank.thread_radius + kHeadShare * (shank.head_radius - shank.thread_radius) : INFINITY;
  shank.end = 1;
  while (shank.end < shank.radii.size() && shank.radii[shank.end] <= limit) ++shank.end;
  if (shank.end < 3) return std::nullopt;
  return shank;
}

}  // namespace dismantle
