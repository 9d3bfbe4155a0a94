// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/cell_grid.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace dismantle {

namespace {

/// Width of the border around the requested box [cells].
constexpr std::int32_t kBorder = 2;

/// Separating axis test of a triangle and a cube; false only if they are disjoint, up to rounding.
bool may_touch(const Triangle& triangle, const Vec3& center, double half) {
  Vec3 corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = triangle[i] - center;
  const auto separated_along = [&](const Vec3& axis) {
    const double a = dot(axis, corners[0]), b = dot(axis, corners[1]), c = dot(axis, corners[2]);
    const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const Vec3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3& unit : units)
    if (separated_along(unit)) return false;
  if (separated_along(cross(corners[1] - corners[0], corners[2] - corners[0]))) return false;
  for (int i = 0; i < 3; ++i)
    for (const Vec3& unit : units)
      if (separated_along(cross(unit, corners[(i + 1) % 3] - corners[i]))) return false;
  return true;
}

/// The six tetrahedra of a cube around its diagonal from corner 0 to 7; corner indices have the bits (x, y, z). Those
/// of neighbouring cubes meet face to face. All have the same orientation.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

/// Marching tetrahedra: builds the surface between corners that are inside and outside, with a vertex at the midpoint
/// of each edge that joins the two kinds.
class SurfaceBuilder {
 public:
  /// Adds the surface within one tetrahedron. @param in, points, names of its corners; a name identifies a grid point
  void add(const std::array<bool, 4>& in, const std::array<Vec3, 4>& points, const std::array<std::size_t, 4>& names) {
    std::vector<int> inner, outer;
    for (int i = 0; i < 4; ++i) (in[static_cast<std::size_t>(i)] ? inner : outer).push_back(i);
    if (inner.empty() || outer.empty()) return;
    const auto on = [&](int a, int b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      return vertex(names[i], names[j], 0.5 * (points[i] + points[j]));
    };
    const Vec3 out = mean(points, outer) - mean(points, inner);
    if (inner.size() == 2) {
      const std::uint32_t a = on(inner[0], outer[0]), b = on(inner[0], outer[1]), c = on(inner[1], outer[1]),
                          d = on(inner[1], outer[0]);
      add_face(a, b, c, out);
      add_face(a, c, d, out);
      return;
    }
    const bool one_in = inner.size() == 1;
    const int tip = one_in ? inner[0] : outer[0];
    const std::vector<int>& base = one_in ? outer : inner;
    add_face(on(tip, base[0]), on(tip, base[1]), on(tip, base[2]), out);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  static Vec3 mean(const std::array<Vec3, 4>& points, const std::vector<int>& which) {
    Vec3 sum;
    for (const int i : which) sum += points[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(which.size());
  }
  std::uint32_t vertex(std::size_t a, std::size_t b, const Vec3& point) {
    const auto [found, is_new] =
        vertices_.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(point);
    return found->second;
  }
  void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vec3& out) {
    const Vec3 normal = cross(mesh_.vertices[b] - mesh_.vertices[a], mesh_.vertices[c] - mesh_.vertices[a]);
    if (dot(normal, out) < 0) std::swap(b, c);
    mesh_.faces.push_back({{a, b, c}});
  }

  TriangleMesh mesh_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> vertices_;
};

}  // namespace

CellGrid::CellGrid(const Vec3& origin, double side, const Cell& count)
    : origin_(origin),
      side_(side),
      count_(count),
      marked_(static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
              static_cast<std::size_t>(count[2])) {}

std::optional<CellGrid> CellGrid::around(const Aabb& box, double side, std::size_t max_cells) {
  DISMANTLE_EXPECT(side > 0 && !box.empty());
  Cell count{};
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = std::floor(box.size()[axis] / side) + 1 + 2 * kBorder;
    cells *= along;
    if (cells > static_cast<double>(max_cells)) return std::nullopt;
    count[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(along);
  }
  return CellGrid(box.lower - kBorder * side * Vec3{1, 1, 1}, side, count);
}

CellGrid::Cell CellGrid::cell_at(const Vec3& point) const {
  Cell p;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double along = std::floor((point[axis] - origin_[axis]) / side_);
    p[i] = static_cast<std::int32_t>(std::clamp(along, 0.0, static_cast<double>(count_[i] - 1)));
  }
  return p;
}

bool CellGrid::is_marked(const Vec3& point) const {
  return marked_[index(cell_at(point))] != 0;
}

void CellGrid::mark(const Triangle& triangle, double margin) {
  Aabb box;
  for (int i = 0; i < 3; ++i) box.extend(triangle[i]);
  const Cell first = cell_at(box.lower - margin * Vec3{1, 1, 1}), last = cell_at(box.upper + margin * Vec3{1, 1, 1});
  const double half = side_ / 2 + margin;
  Cell p;
  for (p[2] = first[2]; p[2] <= last[2]; ++p[2])
    for (p[1] = first[1]; p[1] <= last[1]; ++p[1])
      for (p[0] = first[0]; p[0] <= last[0]; ++p[0]) {
        std::uint8_t& marked = marked_[index(p)];
        if (marked == 0 && may_touch(triangle, corner(p) + 0.5 * side_ * Vec3{1, 1, 1}, half)) marked = 1;
      }
}

std::vector<std::size_t> CellGrid::region_of(const Cell& first, std::vector<std::uint8_t>& seen) const {
  std::vector<std::size_t> cells;
  std::vector<Cell> waiting{first};
  seen[index(first)] = 1;
  while (!waiting.empty()) {
    const Cell p = waiting.back();
    waiting.pop_back();
    cells.push_back(index(p));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int32_t step : {-1, 1}) {
        Cell next = p;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= count_[axis]) continue;
        const std::size_t i = index(next);
        if (seen[i] != 0 || marked_[i] != 0) continue;
        seen[i] = 1;
        waiting.push_back(next);
      }
    }
  }
  return cells;
}

void CellGrid::mark_regions(const std::function<bool(const Vec3&)>& is_inside) {
  std::vector<std::uint8_t> seen(marked_.size());
  region_of({0, 0, 0}, seen);  // the outside: everything connected to the border, which is not marked
  Cell p;
  for (p[2] = 0; p[2] < count_[2]; ++p[2])
    for (p[1] = 0; p[1] < count_[1]; ++p[1])
      for (p[0] = 0; p[0] < count_[0]; ++p[0]) {
        const std::size_t i = index(p);
        if (seen[i] != 0 || marked_[i] != 0) continue;
        const std::vector<std::size_t> region = region_of(p, seen);
        if (!is_inside(corner(p) + 0.5 * side_ * Vec3{1, 1, 1})) continue;
        for (const std::size_t cell : region) marked_[cell] = 1;
      }
}

std::vector<std::uint8_t> CellGrid::corners_of_marked() const {
  std::vector<std::uint8_t> in(marked_.size());
  Cell p;
  for (p[2] = 0; p[2] + 1 < count_[2]; ++p[2])
    for (p[1] = 0; p[1] + 1 < count_[1]; ++p[1])
      for (p[0] = 0; p[0] + 1 < count_[0]; ++p[0]) {
        if (marked_[index(p)] == 0) continue;
        for (std::int32_t i = 0; i < 8; ++i) in[index({p[0] + (i & 1), p[1] + (i >> 1 & 1), p[2] + (i >> 2 & 1)})] = 1;
      }
  return in;
}

TriangleMesh CellGrid::surface() const {
  const std::vector<std::uint8_t> is_corner_in = corners_of_marked();
  SurfaceBuilder builder;
  Cell p;
  for (p[2] = 0; p[2] + 1 < count_[2]; ++p[2])
    for (p[1] = 0; p[1] + 1 < count_[1]; ++p[1])
      for (p[0] = 0; p[0] + 1 < count_[0]; ++p[0]) {
        std::array<bool, 8> in{};
        std::array<Cell, 8> corners;
        for (std::size_t i = 0; i < 8; ++i) {
          corners[i] = {p[0] + static_cast<std::int32_t>(i & 1), p[1] + static_cast<std::int32_t>(i >> 1 & 1),
                        p[2] + static_cast<std::int32_t>(i >> 2 & 1)};
          in[i] = is_corner_in[index(corners[i])] != 0;
        }
        if (std::all_of(in.begin(), in.end(), [&](bool is_in) { return is_in == in[0]; })) continue;
        for (const auto& tetrahedron : kTetrahedra) {
          std::array<bool, 4> is_in{};
          std::array<Vec3, 4> points;
          std::array<std::size_t, 4> names{};
          for (std::size_t k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(tetrahedron[k]);
            is_in[k] = in[i];
            points[k] = corner(corners[i]);
            names[k] = index(corners[i]);
          }
          builder.add(is_in, points, names);
        }
      }
  return builder.take();
}

}  // namespace dismantle
