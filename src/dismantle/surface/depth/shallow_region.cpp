// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/shallow_region.h"

#include "dismantle/surface/depth/near_two_faces.h"
#include "dismantle/surface/depth/solid_depth.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace dismantle {

namespace {

/// Cells are no smaller than this share of the limit, nor of the root.
constexpr double kSmallestOfLimit = 1.0 / 16, kSmallestOfRoot = 1.0 / 512;
/// A query does not examine cells smaller than this share of its own size.
constexpr double kSmallestOfQuery = 1.0 / 8;

constexpr unsigned kCorners = 8;

Vec3 corner_of(Vec3 center, double half, unsigned i) {
  return center + half * Vec3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
}

double longest(Vec3 size) {
  return std::max({size.x, size.y, size.z});
}

}  // namespace

bool ball_outside(const WindingNumber& winding, Vec3 center, double radius, double distance) {
  if (distance <= radius) return false;
  if (winding.closed()) return !winding.inside(center);
  if (winding.fans()->distance(center).distance > radius && holes_do_not_matter(winding, center, radius)) return true;
  const double change = winding.max_change(center, radius);
  return change < 1 && std::abs(winding.at(center)) + change < 0.5 + kUndecidedWinding;
}

bool holes_do_not_matter(const WindingNumber& winding, Vec3 center, double radius) {
  return winding.bound_outside_fans(center, radius) < 0.5 + kUndecidedWinding;
}

/// A hull or a box that is tested.
struct ShallowRegion::Query {
  const PartHull* hull;  // null for a box
  const Aabb& box;
  double smallest;  // half the edge of the smallest cells that are looked at [mm]
  double gap;       // for rounding [mm]

  bool may_meet(const Aabb& cell) const {
    return hull ? hull->may_meet(cell, gap) : overlaps(inflated(box, gap), cell);
  }
};

ShallowRegion::ShallowRegion(const SurfaceTree& surface, const WindingNumber& winding, double limit,
                             const DeeperFaces& deeper)
    : surface_(surface), winding_(winding), limit_(limit), deeper_(deeper), center_(surface.bounds().center()) {
  // Around a solid with holes, points near it may be inside by their winding number.
  half_ = (winding.closed() ? 0.5 : 1) * longest(surface.bounds().size()) + 2 * winding.placement();
  smallest_ = std::max(kSmallestOfLimit * limit, kSmallestOfRoot * half_);
}

ShallowRegion::~ShallowRegion() = default;

bool ShallowRegion::contains(const PartHull& hull) const {
  return contains(&hull, hull.box());
}

bool ShallowRegion::contains(const Aabb& box) const {
  return contains(nullptr, box);
}

bool ShallowRegion::contains(const PartHull* hull, const Aabb& box) const {
  const Vec3 edge{half_, half_, half_};
  const Aabb root{center_ - edge, center_ + edge};
  if (!overlaps(root, box) ||
      (!winding_.closed() && !(min(root.lower, box.lower) == root.lower && max(root.upper, box.upper) == root.upper))) {
    if (winding_.closed()) return true;
    const Vec3 center = box.center();
    return ball_outside(winding_, center, diagonal(box) / 2, surface_.distance(center).distance);
  }
  const double smallest = std::max(smallest_, kSmallestOfQuery * longest(box.size()));
  return contains({hull, box, smallest, winding_.placement()}, root_, center_, half_);
}

bool ShallowRegion::contains(const Query& query, Cell& cell, Vec3 center, double half) const {
  const Vec3 edge{half, half, half};
  if (!query.may_meet({center - edge, center + edge})) return true;
  State state = cell.state.load(std::memory_order_relaxed);
  if (state == State::Unknown) cell.state.store(state = examine(center, half), std::memory_order_relaxed);
  if (state != State::Mixed) return state == State::Shallow;
  if (half / 2 < query.smallest) return false;
  Cell* children = cell.children.load(std::memory_order_acquire);
  if (!children) {
    auto fresh = std::make_unique<Cell[]>(kCorners);
    if (cell.children.compare_exchange_strong(children, fresh.get(), std::memory_order_acq_rel))
      children = fresh.release();
  }
  for (unsigned i = 0; i < kCorners; ++i)
    if (!contains(query, children[i], corner_of(center, half / 2, i), half / 2)) return false;
  return true;
}

ShallowRegion::State ShallowRegion::examine(Vec3 center, double half) const {
  const double radius = std::sqrt(3.0) * half;
  const MeshDistance nearest = surface_.distance(center);
  if (nearest.distance + radius <= limit_) return State::Shallow;
  Vec3 corners[kCorners];
  for (unsigned i = 0; i < kCorners; ++i) corners[i] = corner_of(center, half, i);
  const Span<const Vec3> hull(corners, kCorners);
  if (near_two_faces(surface_, hull, nearest.face, limit_)) return State::Shallow;
  bool may_be_deeper = false;
  if (deeper_.faces && nearest.distance - radius <= deeper_.limit) {
    const MeshDistance deeper = deeper_.faces->distance(center, 0, deeper_.limit + radius);
    if (deeper.distance + radius <= deeper_.limit || near_two_faces(*deeper_.faces, hull, deeper.face, deeper_.limit))
      return State::Shallow;
    may_be_deeper = deeper.distance - radius <= deeper_.limit;
  }
  if (nearest.distance <= radius) return State::Mixed;
  if (ball_outside(winding_, center, radius, nearest.distance)) return State::Shallow;
  const bool is_beyond = nearest.distance - radius > limit_ && !may_be_deeper;
  return is_beyond && winding_.inside(center) ? State::Deep : State::Mixed;
}

}  // namespace dismantle
