// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/meshes.h"
#include "tests/support/swept_meshes.h"

#include <array>
#include <map>
#include <string>
#include <vector>

/// Assemblies that come apart only around a corner or by turning, or not at all.
namespace dismantle::scenes {

/// A grid of cells.
struct CellGrid {
  std::array<int, 3> size;  ///< In cells.
  bool periodic = false;    ///< The second index wraps around.
};

/// A closed solid made of those cells of a grid for which `solid(i, j, k)`. `position(i, j, k)` gives the grid's
/// points, right-handed.

template <class Position, class Solid>
TriangleMesh cell_block(const CellGrid& grid, Position position, Solid solid) {
  TriangleMesh m;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](std::array<int, 3> k) {
    if (grid.periodic) k[1] %= grid.size[1];
    const auto [found, fresh] = known.try_emplace(k, static_cast<std::uint32_t>(m.vertices.size()));
    if (fresh) m.vertices.push_back(position(k[0], k[1], k[2]));
    return found->second;
  };
  const auto is_solid = [&](std::array<int, 3> k) {
    if (grid.periodic) k[1] = (k[1] + grid.size[1]) % grid.size[1];
    for (std::size_t a = 0; a < 3; ++a)
      if (k[a] < 0 || k[a] >= grid.size[a]) return false;
    return static_cast<bool>(solid(k[0], k[1], k[2]));
  };
  for (int cell = 0; cell < grid.size[0] * grid.size[1] * grid.size[2]; ++cell) {
    const std::array<int, 3> at{cell / (grid.size[1] * grid.size[2]), cell / grid.size[2] % grid.size[1],
                                cell % grid.size[2]};
    for (std::size_t axis = 0; axis < 3 && is_solid(at); ++axis)
      for (const int side : {0, 1}) {
        std::array<int, 3> next = at, corner = at;
        next[axis] += 2 * side - 1;
        if (is_solid(next)) continue;
        corner[axis] += side;
        std::array<int, 3> b = corner, c = corner, d = corner;
        ++b[(axis + 1) % 3], ++c[(axis + 1) % 3], ++c[(axis + 2) % 3], ++d[(axis + 2) % 3];
        if (side == 0) std::swap(b, d);
        add_quad(m, vertex(corner), vertex(b), vertex(c), vertex(d));
      }
  }
  return m;
}

/// The same between planes along the axes, at these coordinates [mm].
template <class Solid>
TriangleMesh box_block(const std::array<std::vector<double>, 3>& at, Solid solid) {
  const auto cells = [&](std::size_t axis) { return static_cast<int>(at[axis].size()) - 1; };
  const auto place = [&](int i, int j, int k) {
    return Vec3{at[0][static_cast<std::size_t>(i)], at[1][static_cast<std::size_t>(j)],
                at[2][static_cast<std::size_t>(k)]};
  };
  return cell_block({{cells(0), cells(1), cells(2)}}, place, solid);
}

/// The same between radii and heights about z [mm], the full turn in `sides` sectors.
template <class Solid>
TriangleMesh round_block(const std::vector<double>& radii, const std::vector<double>& heights, int sides, Solid solid) {
  const auto place = [&](int i, int j, int k) {
    const double r = radii[static_cast<std::size_t>(i)], angle = kTurn * j / sides;
    return Vec3{r * std::cos(angle), r * std::sin(angle), heights[static_cast<std::size_t>(k)]};
  };
  return cell_block({{static_cast<int>(radii.size()) - 1, sides, static_cast<int>(heights.size()) - 1}, true}, place,
                    solid);
}

/// A frame along z around a square hole of the half width `half`.
inline TriangleMesh frame(double half, double wall, double z0, double z1) {
  return extruded_band(square_around(half + wall, 8), square_around(half, 8), true, z0, z1);
}

/// A box in a shell without an opening.
inline Assembly closed_shell() {
  TriangleMesh shell = box({-10, -10, -10}, {10, 10, 10});
  TriangleMesh hollow = box({-8, -8, -8}, {8, 8, 8});
  const auto first = static_cast<std::uint32_t>(shell.vertices.size());
  shell.vertices.insert(shell.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (const Face& f : hollow.faces) shell.faces.push_back({{f.v[0] + first, f.v[2] + first, f.v[1] + first}});
  return assembly({component("shell", shell), component("core", box({-5, -5, -8}, {5, 5, 2}))});
}

/// Two links of a chain, one turned about x and through the other.
inline std::vector<Component> chain_links() {
  const TriangleMesh link = frame(5, 2, -1, 1);
  const Pose through{{7, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)};
  return {component("link", link), component("next link", moved(link, through))};
}

/// A circular rod bent along a polyline, closed at its ends.
inline TriangleMesh bent_rod(const std::vector<Vec3>& line, double radius, std::uint32_t sides) {
  TriangleMesh m;
  Vec3 aside;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Vec3 along = normalized(line[std::min(k + 1, line.size() - 1)] - line[k == 0 ? 0 : k - 1]);
    if (k == 0) aside = cross(along, std::abs(along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
    aside = normalized(aside - dot(aside, along) * along);
    const Vec3 other = cross(along, aside);
    for (std::uint32_t i = 0; i < sides; ++i)
      m.vertices.push_back(line[k] +
                           radius * (std::cos(kTurn * i / sides) * aside + std::sin(kTurn * i / sides) * other));
  }
  const auto last = static_cast<std::uint32_t>((line.size() - 1) * sides);
  for (std::uint32_t k = 0; k < last; k += sides)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      add_quad(m, k + i, k + j, k + sides + j, k + sides + i);
    }
  for (std::uint32_t i = 1; i + 1 < sides; ++i) {
    m.faces.push_back({{0, i + 1, i}});
    m.faces.push_back({{last, last + i, last + i + 1}});
  }
  return m;
}

/// Two open rings through each other, the gap of each turned away from the other: one rod must pass through the other's
/// gap. The rods are 3 mm thick, the gaps `gap` wide along the rods' centre lines [mm].
inline std::vector<Component> open_rings(double gap) {
  const double ring = 10, rod = 1.5;
  const auto open_ring = [&](double toward) {
    const double half = std::asin(gap / 2 / ring);
    std::vector<Vec3> line;
    for (int k = 0; k <= 48; ++k) {
      const double angle = toward + half + (kTurn - 2 * half) * k / 48;
      line.push_back({ring * std::cos(angle), ring * std::sin(angle), 0});
    }
    return bent_rod(line, rod, 12);
  };
  const Pose through{{ring, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)};
  return {component("ring", open_ring(kTurn / 2)), component("other ring", moved(open_ring(0), through))};
}

/// A pin in an L-shaped tunnel of a block: along x, then out along y. `clearance` on every side [mm].
inline std::vector<Component> l_slot(double clearance) {
  const double c = clearance, wide = 6 + 2 * c;
  const TriangleMesh block =
      box_block({{{-10, 0, 10, 10 + wide, 26}, {-10, 0, wide, 20}, {-5, 0, wide, 12}}}, [](int x, int y, int z) {
        const bool tunnel = z == 1 && (((x == 1 || x == 2) && y == 1) || (x == 2 && y == 2));
        return !tunnel;
      });
  return {component("block", block), component("pin", box({c, c, c}, {6 + c, 6 + c, 6 + c}))};
}

/// A hook around a bar, between two plates that confine it to its plane: it moves down, aside from under the bar, and
/// up beside it. `clearance` between hook and plates [mm].
///
///     #        ##   bar: ##### with the hook's mouth around its end
///     #####  [  #
///     #      [[[#   floor below
///     ###########
inline std::vector<Component> hook(double clearance) {
  const double c = clearance;
  const TriangleMesh frame = box_block({{{-20, -12, 0, 14, 20}, {-14, -10, 0, 4}, {0, 10}}}, [](int x, int y, int) {
    return x == 0 || y == 0 || x == 3 || (x == 1 && y == 2);
  });
  const TriangleMesh body =
      box_block({{{-6, c, 4}, {-4, -c, 4 + c, 8}, {c, 10 - c}}}, [](int x, int y, int) { return x == 1 || y != 1; });
  return {component("frame", frame), component("front", box({-24, -18, -4}, {24, 12, 0})),
          component("back", box({-24, -18, 10}, {24, 12, 14})), component("hook", body)};
}

/// A plug with two lugs in a socket: after a tenth of a turn, up to stops, its lugs are below their slots, and it comes
/// out along z. `clearance` all around [mm], at least 0.05 for the sides.
inline std::vector<Component> bayonet(double clearance) {
  constexpr int kSides = 48;
  const double c = clearance;
  const auto within = [](int sector, int first, int last) { return sector % 24 >= first && sector % 24 < last; };
  const TriangleMesh socket =
      round_block({5 + c, 7 + c, 10}, {-2, 2 - c, 4 + c, 10}, kSides, [&](int ring, int sector, int layer) {
        if (ring == 1 || layer == 0) return true;
        return layer == 1 ? within(sector, 13, 22) : !within(sector, 8, 13);
      });
  const TriangleMesh plug = round_block({2, 5, 7}, {0, 2, 4, 20}, kSides, [&](int ring, int sector, int layer) {
    return ring == 0 || (layer == 1 && within(sector, 0, 4));
  });
  return {component("socket", socket), component("plug", plug)};
}

}  // namespace dismantle::scenes
