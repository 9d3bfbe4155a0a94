// SPDX-License-Identifier: Apache-2.0
#include "bench/families/ghost_oracle.h"

#include <algorithm>
#include <cmath>

namespace dismantle::families {

namespace {

/// Chords of a point and its ghosts differ from their arcs by no more than this share of the allowance.
constexpr double kBow = 0.02;
/// Ghosts are made no nearer to the surface than this share of the last allowance.
constexpr double kOff = 0.02;

}  // namespace

struct GhostOracle::State {
  Vec3 point;
  const GhostEffort* effort = nullptr;
  double time = 0;
  bool clear = false;         // nothing is within the allowance
  std::vector<Vec3> offsets;  // of possible ghosts [mm, frame of the body]
  std::mt19937_64 random{1};
};

std::optional<double> GhostOracle::follow(Vec3 point, const GhostEffort& effort) const {
  State state;
  state.point = point;
  state.effort = &effort;
  start(state);
  if (!state.clear && state.offsets.empty()) return 0.0;
  while (state.time < track_.end()) {
    const auto frame = static_cast<std::size_t>(state.time);
    const double limit = allowance_.at(frame);
    const Vec3 here = track_.at(state.time) * point;
    const double distance = other_.nearest(here).distance;
    state.clear = distance > limit;
    if (state.clear) {
      state.offsets.assign(1, {});
      state.time = clear_until(state, distance - limit);
      continue;
    }
    if (!step(state, next_time(state, limit), limit)) return state.time;
  }
  return std::nullopt;
}

/// A time up to which a point moves by no more than `way`.
double GhostOracle::clear_until(const State& state, double way) const {
  double time = state.time;
  while (time < track_.end()) {
    const auto k = static_cast<std::size_t>(time);
    const double next = static_cast<double>(k + 1);
    const double turn = track_.angle(k) * (next - time);
    const double chord = length(track_.at(next) * state.point - track_.at(time) * state.point);
    const double arc = (turn < 0.5 ? 1.02 : 1.6) * chord;  // half a circle is 1.571 times its chord
    if (arc > way) {
      time += 0.9 * way / arc * (next - time);
      break;
    }
    way -= arc;
    time = next;
    if (allowance_.at(k + 1) != allowance_.at(k)) break;
  }
  return std::max(time, std::nextafter(state.time, track_.end() + 1));
}

void GhostOracle::start(State& state) const {
  const double limit = allowance_.at(0);
  const RigidTransform at = track_.at(0);
  const Vec3 here = at * state.point;
  const auto take = [&](Vec3 place) {
    if (length(place - here) > limit) return;
    const NearestFace found = other_.nearest(place);
    if (found.distance < kOff * allowance_.limit_after_parting || other_.inside(place, found)) return;
    state.offsets.push_back(inverse(at) * place - state.point);
  };
  const NearestFace near = other_.nearest(here);
  state.clear = near.distance > limit && !other_.inside(here, near);
  if (state.clear) return;
  take(here);
  const Vec3 out = near.distance > 0 ? (near.point - here) / near.distance : Vec3{};
  for (const double beyond : {0.1, 0.4, 0.8}) take(near.point + beyond * std::max(0.0, limit - near.distance) * out);
  for (const double share : {0.98, 0.5, 0.15})
    for (int i = 0; i < 27; ++i) {
      const Vec3 d{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
      if (i != 13) take(here + share * limit * normalized(d));
    }
  std::uniform_real_distribution<double> u(-1, 1);
  const std::size_t tries = state.effort->random + (state.offsets.empty() ? 300 : 0);
  for (std::size_t i = 0; i < tries; ++i) take(here + limit * Vec3{u(state.random), u(state.random), u(state.random)});
}

/// The end of the next motion that is short enough to be taken as straight.
double GhostOracle::next_time(const State& state, double limit) const {
  const auto k = static_cast<std::size_t>(state.time);
  const double next = static_cast<double>(k + 1);
  const Vec3 here = track_.at(state.time) * state.point;
  const double turn = track_.angle(k) * (next - state.time);
  const double chord = length(track_.at(next) * state.point - here);
  const double most = state.effort->largest_step * limit;
  const double share = chord > most ? std::max(most / chord, 1e-4) : 1;
  if (turn > 0) {
    const double bow = turn < 2 ? chord * turn / 4 : 10 * limit + other_.radius();
    if (bow > kBow * limit)
      return state.time + (next - state.time) * std::clamp(std::sqrt(kBow * limit / bow), 1e-4, std::min(0.5, share));
  }
  if (share < 1) return state.time + (next - state.time) * share;
  // Motions of no length are taken together.
  double time = next;
  while (time < track_.end() && allowance_.at(static_cast<std::size_t>(time)) == allowance_.at(k) &&
         length(track_.at(time + 1) * state.point - here) < kBow * limit &&
         track_.angle(static_cast<std::size_t>(time)) < 0.1)
    time += 1;
  return time;
}

/// Moves the ghosts along with the point. @return false if none can follow
bool GhostOracle::step(State& state, double to, double limit) const {
  std::vector<double> ends{to};
  while (!ends.empty()) {
    const double end = ends.back();
    const RigidTransform from = track_.at(state.time), then = track_.at(end);
    const Vec3 motion = then * state.point - from * state.point;
    bool moved = false;
    for (const bool more : {false, true}) {
      if (more) spawn(state, from, motion, limit);
      std::vector<Vec3> left;
      for (const Vec3& o : state.offsets)
        if (!other_.crossed(from * (state.point + o), then * (state.point + o))) left.push_back(o);
      if (left.empty()) continue;
      state.offsets = std::move(left);
      moved = true;
      break;
    }
    if (!moved) {
      const double middle = (state.time + end) / 2;
      if (length(motion) < state.effort->smallest_step * limit || middle <= state.time || middle >= end) return false;
      ends.push_back(middle);
      continue;
    }
    ends.pop_back();
    state.time = end;
    if (state.offsets.size() < state.effort->few || state.effort->random > 0) spawn(state, then, motion, limit);
  }
  return true;
}

/// Adds places that can be reached from the present ones.
void GhostOracle::spawn(State& state, const RigidTransform& at, Vec3 motion, double limit) const {
  const Vec3 here = at * state.point;
  const RigidTransform back = inverse(at);
  std::vector<Vec3> places;
  if (length(motion) > 0)
    for (const double share : {0.98, 0.6, 0.3, 0.1}) places.push_back(here - share * limit * normalized(motion));
  const NearestFace near = other_.nearest(here);
  if (near.distance > 0)
    for (const double by : {-0.95, -0.4, 0.1, 0.4, 0.8}) {
      const Vec3 toward = (near.point - here) / near.distance;
      const double left = std::max(0.0, limit - near.distance);
      places.push_back(by < 0 ? here + by * limit * toward : near.point + by * left * toward);
    }
  for (const double share : {0.98, 0.5})
    for (int i = 0; i < 27; ++i)
      if (i != 13) places.push_back(here + share * limit * normalized(Vec3{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}));
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t i = 0; i < state.effort->random; ++i)
    places.push_back(here + limit * Vec3{u(state.random), u(state.random), u(state.random)});
  std::vector<Vec3> known;
  for (const Vec3& o : state.offsets) known.push_back(at * (state.point + o));
  const std::size_t kept = known.size();
  for (int round = 0; round < 2; ++round)
    for (const Vec3& p : places) {
      if (known.size() >= kept + state.effort->most) break;
      if (length(p - here) > limit ||
          other_.nearest(p, kOff * allowance_.limit_after_parting).distance < kOff * allowance_.limit_after_parting)
        continue;
      const auto seen = [&](Vec3 q) { return length(q - p) < 0.05 * limit; };
      if (std::any_of(known.begin(), known.end(), seen)) continue;
      const auto reaches = [&](Vec3 q) { return !other_.crossed(q, p); };
      if (!std::any_of(known.begin(), known.end(), reaches)) continue;
      known.push_back(p);
      state.offsets.push_back(back * p - state.point);
    }
  if (state.offsets.size() > 2 * state.effort->most)
    state.offsets.erase(state.offsets.begin(), state.offsets.end() - static_cast<std::ptrdiff_t>(state.effort->most));
}

}  // namespace dismantle::families
