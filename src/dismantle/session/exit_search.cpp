// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/exit_search.h"

#include "dismantle/session/session_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Margin outside the bounding box, as a share of the assembly's diagonal.
constexpr double kMarginShare = 0.02;
/// Cosine above which directions count as the same (about 2.5 degrees).
constexpr double kSameDirection = 0.999;
constexpr std::size_t kMaxDirections = 32;
/// A direction free for less than this share of the exit distance is left out.
constexpr double kNowhereShare = 0.01;

void add_direction(std::vector<Vec3>& list, const Vec3& direction) {
  const double l = length(direction);
  if (!(l > 0) || list.size() >= kMaxDirections) return;
  const Vec3 unit = direction / l;
  for (const Vec3& known : list)
    if (dot(known, unit) > kSameDirection) return;
  list.push_back(unit);
}

}  // namespace

ExitSearch::ExitSearch(const Assembly& assembly, const CertificateEngine& engine, Span<const ComponentId> set)
    : assembly_(assembly), engine_(engine), pose_(engine.poses()[set[0].value]), all_(assembled_bounds(assembly)) {
  for (const ComponentId c : set) box_.extend(bounds_at(assembly_[c], pose_));
}

bool ExitSearch::is_outside() const {
  return !overlaps(all_, box_);
}

Vec3 ExitSearch::outward() const {
  const Vec3 way = box_.center() - all_.center();
  return length(way) > 0 ? normalized(way) : Vec3{0, 0, 1};
}

double ExitSearch::exit_distance(const Vec3& direction) const {
  if (is_outside()) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] > 0) least = std::min(least, (all_.upper[k] - box_.lower[k]) / direction[k]);
    if (direction[k] < 0) least = std::min(least, (all_.lower[k] - box_.upper[k]) / direction[k]);
  }
  return least + kMarginShare * diagonal(all_);
}

std::vector<FreeDirection> ExitSearch::free_distances(Span<const Vec3> directions) const {
  std::vector<Vec3> ways;
  std::vector<FreeDirection> result;
  for (const Vec3& d : directions) {
    result.push_back({d, false, exit_distance(d), {}});
    ways.push_back(result.back().distance * d);
  }
  const std::vector<FirstContact> contacts = engine_.straight_contacts(ways);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    result[i].free = contacts[i].free;
    if (contacts[i].free) continue;
    result[i].distance *= contacts[i].toi;
    result[i].blocked_by = contacts[i].fixed;
  }
  return result;
}

std::vector<FreeDirection> ExitSearch::find(double contact_reach) const {
  std::vector<Vec3> directions;
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    add_direction(directions, axis);
    add_direction(directions, -axis);
  }
  Vec3 sum;
  for (const ContactPoint& c : engine_.contacts(contact_reach)) {
    add_direction(directions, c.normal);
    sum += c.normal;
  }
  add_direction(directions, sum);

  // Most directions are blocked soon: a short query decides that and is cheap compared with a full one.
  std::vector<Vec3> near;
  near.reserve(directions.size());
  for (const Vec3& d : directions) near.push_back((kNowhereShare * exit_distance(d)) * d);
  const std::vector<FirstContact> contacts = engine_.straight_contacts(near);
  std::vector<Vec3> open;
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (contacts[i].free) open.push_back(directions[i]);

  std::vector<FreeDirection> found = free_distances(open);
  std::erase_if(found, [&](const FreeDirection& d) {
    return !d.free && d.distance < kNowhereShare * exit_distance(d.direction);
  });
  std::stable_sort(found.begin(), found.end(), [](const FreeDirection& a, const FreeDirection& b) {
    if (a.free != b.free) return a.free;
    return a.free ? a.distance < b.distance : a.distance > b.distance;
  });
  return found;
}

}  // namespace dismantle
