// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/depth/part_hull.h"
#include "dismantle/surface/surface_tree.h"
#include "dismantle/surface/winding_number.h"

#include <atomic>
#include <cstdint>

namespace dismantle {

/// True if a ball is certainly outside a solid. @param distance of its center from the surface [mm]
bool ball_outside(const WindingNumber& winding, Vec3 center, double radius, double distance);
/// True if the mesh closed by its fans is not around the center of a ball, nor do the holes by themselves make an
/// inside of any point of the ball. @pre the ball meets neither the mesh nor a fan
bool holes_do_not_matter(const WindingNumber& winding, Vec3 center, double radius);

/// Faces of a surface next to which points may be deeper than elsewhere.
struct DeeperFaces {
  const SurfaceTree* faces = nullptr;  ///< Null for none.
  double limit = 0;                    ///< Of the distance from them [mm].
};

/// The points that are outside a solid, or inside it but no deeper than a limit, or a larger one next to some of its
/// faces: an octree whose cells are examined when they are first asked for, and kept (as in the adaptively sampled
/// distance fields of Frisken et al. 2000, with bounds instead of interpolation). What it answers does not depend on
/// what was asked before; may be shared between threads.
class ShallowRegion {
 public:
  /// @param surface, winding of the solid; must outlive this @param limit of the depth [mm] @param deeper
  /// faces of the surface
  ShallowRegion(const SurfaceTree& surface, const WindingNumber& winding, double limit, const DeeperFaces& deeper = {});
  ShallowRegion(const ShallowRegion&) = delete;
  ShallowRegion& operator=(const ShallowRegion&) = delete;
  ~ShallowRegion();

  /// True if all points of a hull are certainly in the region; false says nothing.
  bool contains(const PartHull& hull) const;
  /// The same for a box [mm].
  bool contains(const Aabb& box) const;

 private:
  enum class State : std::uint8_t {
    Unknown,
    Shallow,  // in the region
    Deep,     // no point of it is in the region
    Mixed,    // neither is certain
  };
  struct Cell {
    std::atomic<State> state = State::Unknown;
    std::atomic<Cell*> children = nullptr;  // eight of them
    ~Cell() { delete[] children.load(); }
  };
  struct Query;

  bool contains(const PartHull* hull, const Aabb& box) const;
  bool contains(const Query& query, Cell& cell, Vec3 center, double half) const;
  State examine(Vec3 center, double half) const;

  const SurfaceTree& surface_;
  const WindingNumber& winding_;
  double limit_;
  DeeperFaces deeper_;
  Vec3 center_;
  double half_ = 0;      // of the root's edges [mm]
  double smallest_ = 0;  // the same of the smallest cells
  mutable Cell root_;
};

}  // namespace dismantle
