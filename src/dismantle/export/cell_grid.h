// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace dismantle {

/// A grid of cubes some of which are marked. What is at the border never is.
class CellGrid {
 public:
  /// A grid that holds a box, with two cells more on each side; nothing where it would have more than `most` cells.
  /// @param side of a cell [mm], above 0
  static std::optional<CellGrid> around(const Aabb& box, double side, std::size_t most);

  double side() const { return side_; }
  /// Marks the cells that a triangle touches, or whose cube enlarged by `margin` on all sides does, up to rounding.
  /// @pre the enlarged triangle is in the box that the grid is around, enlarged by a cell
  void mark(const Triangle& triangle, double margin);
  bool is_marked(const Vec3& point) const;
  /// Marks whole regions of cells that are not marked, and do not reach the border: those of whose cells `is_inside`
  /// says yes for the middle of the first.
  void mark_regions(const std::function<bool(const Vec3&)>& is_inside);
  /// A closed surface around all marked cells, nowhere further from one than half its diagonal; every edge has two
  /// faces, normals lead out.
  TriangleMesh surface() const;

 private:
  using Place = std::array<std::int32_t, 3>;

  CellGrid(const Vec3& origin, double side, const Place& count);
  std::size_t index(const Place& p) const {
    return (static_cast<std::size_t>(p[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(p[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(p[0]);
  }
  Vec3 corner(const Place& p) const {
    return origin_ + side_ * Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  Place place(const Vec3& point) const;
  /// 1 for each corner of a cell that is one of a marked cell; named as the cell above it.
  std::vector<std::uint8_t> corners_of_marked() const;
  std::vector<std::size_t> region_of(const Place& first, std::vector<std::uint8_t>& seen) const;

  Vec3 origin_;
  double side_;
  Place count_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace dismantle
