// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/component_axes.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Limits of the directions and axes that a sliding component is pushed along and turned about.
constexpr std::size_t kMaxPushes = 12;
constexpr std::size_t kMaxTurns = 4;
/// Two threads have one axis if their directions differ by less than this [rad], and their places by less than this
/// share of the component's radius.
constexpr double kSameAxis = 0.05;

}  // namespace

ComponentAxes::ComponentAxes(const PlannedAssembly& planned, MotionValidator& validator)
    : planned_(planned),
      validator_(validator),
      threads_(planned.size()),
      modelled_(planned.size()),
      revolution_axes_(planned.size()) {}

const std::vector<NeighbourThread>& ComponentAxes::threads_of(ComponentId c) {
  std::optional<std::vector<NeighbourThread>>& known = threads_[c.value];
  if (known) return *known;
  known.emplace();
  for (const ComponentId other : neighbours_of(c))
    for (const ThreadAxis& thread : modelled_threads(c))
      for (const ThreadAxis& its : modelled_threads(other))
        if (threads_mate(thread, its)) known->push_back({other, better_known(thread, its)});
  if (known->empty())
    known =
        touched_threads(planned_.assembly, validator_.hold(c), planned_.features[c.value].radius, planned_.tolerance);
  return *known;
}

bool ComponentAxes::may_turn(ComponentId c, const ThreadAxis& about, const ComponentSet& body) {
  const double reach = kSameAxis * planned_.features[c.value].radius;
  const auto is_other = [&](const NeighbourThread& known) {
    const Vec3 off = cross(about.direction, known.thread.point - about.point);
    return body.has(known.neighbour) &&
           (length(cross(known.thread.direction, about.direction)) > kSameAxis || length(off) > reach);
  };
  const std::vector<NeighbourThread>& threads = threads_of(c);
  return std::count_if(threads.begin(), threads.end(), is_other) < 2;
}

SlideMoves ComponentAxes::slide_moves(ComponentId c, const ComponentSet& body, const DirectionChoice& choice,
                                      const BlockingTable& table) {
  SlideMoves moves;
  for (const DirectionId d : choice.directions()[c.value])
    if (moves.directions.size() < kMaxPushes) moves.directions.push_back(table.direction(d));
  const auto add = [&](const RevolutionAxis& axis) {
    const auto same = [&](const TurnAxis& known) {
      return length(cross(known.direction, axis.direction)) < kSameDirectionAngle &&
             length(cross(axis.direction, known.point - axis.point)) <
                 kSameDirectionAngle * planned_.features[c.value].radius;
    };
    if (moves.axes.size() < kMaxTurns && std::none_of(moves.axes.begin(), moves.axes.end(), same))
      moves.axes.push_back({axis.point, axis.direction});
  };
  for (const RevolutionAxis& axis : revolution_axes_of(c)) add(axis);
  for (const ComponentId near : choice.contacts(c).neighbours)
    if (body.has(near))
      for (const RevolutionAxis& axis : revolution_axes_of(near)) add(axis);
  for (const WeightedDirection& axis : planned_.features[c.value].axes)
    add({planned_.features[c.value].center, axis.direction, 0});
  return moves;
}

const std::vector<RevolutionAxis>& ComponentAxes::revolution_axes_of(ComponentId c) {
  std::optional<std::vector<RevolutionAxis>>& known = revolution_axes_[c.value];
  if (!known) {
    const TriangleMesh mesh = assembled_mesh(planned_.assembly[c]);
    known = revolution_axes(mesh.vertices, mesh.faces);
  }
  return *known;
}

const std::vector<ThreadAxis>& ComponentAxes::modelled_threads(ComponentId c) {
  std::optional<std::vector<ThreadAxis>>& known = modelled_[c.value];
  if (!known) {
    const TriangleMesh mesh = assembled_mesh(planned_.assembly[c]);
    known = thread_axes(mesh.vertices, mesh.faces, revolution_axes_of(c));
  }
  return *known;
}

// The others whose bounding spheres meet its own.
std::vector<ComponentId> ComponentAxes::neighbours_of(ComponentId c) const {
  std::vector<ComponentId> near;
  for (std::uint32_t k = 0; k < planned_.size(); ++k)
    if (k != c.value && length(planned_.features[k].center - planned_.features[c.value].center) <
                            planned_.features[k].radius + planned_.features[c.value].radius)
      near.emplace_back(k);
  return near;
}

}  // namespace dismantle
