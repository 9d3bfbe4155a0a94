// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace dismantle {

/// A grid of cubic cells, some of which are marked; cells at the border never are.
class CellGrid {
 public:
  /// A grid around a box, with a border of two cells on each side; nothing if it would have more than `max_cells`.
  /// @param side edge length of a cell [mm], above 0
  static std::optional<CellGrid> around(const Aabb& box, double side, std::size_t max_cells);

  /// Edge length of a cell [mm].
  double side() const { return side_; }
  /// Marks every cell whose cube, enlarged by `margin` [mm] on all sides, meets the triangle. Conservative up to
  /// rounding.
  /// @pre the triangle, enlarged by `margin`, is within the box given to around(), enlarged by one cell
  void mark(const Triangle& triangle, double margin);
  /// True if the cell that contains the point is marked.
  bool is_marked(const Vec3& point) const;
  /// Fills cavities: marks each connected region of unmarked cells that does not reach the border, if `is_inside` is
  /// true for the centre of the region's first cell [mm].
  void mark_regions(const std::function<bool(const Vec3&)>& is_inside);
  /// A closed surface around all marked cells, nowhere further from one than half a cell's diagonal. Manifold, with
  /// outward normals.
  TriangleMesh surface() const;

 private:
  using Cell = std::array<std::int32_t, 3>;  // indices along x, y, z

  CellGrid(const Vec3& origin, double side, const Cell& count);
  std::size_t index(const Cell& p) const {
    return (static_cast<std::size_t>(p[2]) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(p[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(p[0]);
  }
  Vec3 corner(const Cell& p) const {
    return origin_ + side_ * Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  /// The cell that contains a point, clamped to the grid.
  Cell cell_at(const Vec3& point) const;
  /// 1 for each grid point that is a corner of a marked cell; indexed by the cell of which it is the lower corner.
  std::vector<std::uint8_t> corners_of_marked() const;
  std::vector<std::size_t> region_of(const Cell& first, std::vector<std::uint8_t>& seen) const;

  Vec3 origin_;
  double side_;
  Cell count_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace dismantle
