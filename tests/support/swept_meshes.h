// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// Closed meshes, normals out, made by revolving, extruding or winding a profile.
namespace dismantle::scenes {

/// A point of a plane profile: (x, y) of an extruded one, (radius, z) of a revolved one [mm].
struct ProfilePoint {
  double x = 0, y = 0;
};
using Profile = std::vector<ProfilePoint>;

inline void add_quad(TriangleMesh& m, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  m.faces.push_back({{a, b, c}});
  m.faces.push_back({{a, c, d}});
}

/// The profile with points added on its edges, so that no edge is longer than `length`; without an end point.
inline Profile subdivided(const Profile& profile, double length, bool loop) {
  Profile fine;
  for (std::size_t k = 0; k + (loop ? 0 : 1) < profile.size(); ++k) {
    const ProfilePoint a = profile[k], b = profile[(k + 1) % profile.size()];
    const int count = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / length)));
    for (int i = 0; i < count; ++i) fine.push_back({a.x + (b.x - a.x) * i / count, a.y + (b.y - a.y) * i / count});
  }
  if (!loop) fine.push_back(profile.back());
  return fine;
}

/// A solid of revolution about z: the profile (radius, z) goes up from the axis to the axis, with radius 0 at its two
/// ends only.
inline TriangleMesh revolved(const Profile& profile, std::uint32_t sides) {
  TriangleMesh m;
  for (std::size_t k = 1; k + 1 < profile.size(); ++k)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = kTurn * i / sides;
      m.vertices.push_back({profile[k].x * std::cos(angle), profile[k].x * std::sin(angle), profile[k].y});
    }
  const auto low = static_cast<std::uint32_t>(m.vertices.size()), high = low + 1, top = low - sides;
  m.vertices.push_back({0, 0, profile.front().y});
  m.vertices.push_back({0, 0, profile.back().y});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    m.faces.push_back({{low, j, i}});
    for (std::uint32_t k = 0; k < top; k += sides) add_quad(m, k + i, k + j, k + sides + j, k + sides + i);
    m.faces.push_back({{top + i, top + j, high}});
  }
  return m;
}

/// A ring about z: the profile (radius, z) is a loop, counter-clockwise, that keeps off the axis.
inline TriangleMesh revolved_loop(const Profile& profile, std::uint32_t sides) {
  TriangleMesh m;
  for (const ProfilePoint& p : profile)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = kTurn * i / sides;
      m.vertices.push_back({p.x * std::cos(angle), p.x * std::sin(angle), p.y});
    }
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t k = 0; k < count; ++k)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides, low = k * sides, high = (k + 1) % count * sides;
      add_quad(m, low + i, low + j, high + j, high + i);
    }
  return m;
}

/// The band between two chains of equally many points (x, y), extruded along z in `layers` layers. Its boundary, along
/// `outer` and back along `inner`, is counter-clockwise; with `ring`, each chain is closed instead.
inline TriangleMesh extruded_band(const Profile& outer, const Profile& inner, bool ring, double z0, double z1,
                                  std::uint32_t layers = 1) {
  TriangleMesh m;
  const auto n = static_cast<std::uint32_t>(outer.size());
  for (std::uint32_t k = 0; k <= layers; ++k)
    for (const Profile* chain : {&outer, &inner})
      for (const ProfilePoint& p : *chain) m.vertices.push_back({p.x, p.y, z0 + (z1 - z0) * k / layers});
  const std::uint32_t top = layers * 2 * n;
  const auto wall = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t k = 0; k < top; k += 2 * n) add_quad(m, k + from, k + to, k + 2 * n + to, k + 2 * n + from);
  };
  for (std::uint32_t i = 0; i + (ring ? 0 : 1) < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    wall(i, j);
    wall(n + j, n + i);
    add_quad(m, top + i, top + j, top + n + j, top + n + i);
    add_quad(m, j, i, n + i, n + j);
  }
  if (!ring) {
    wall(n - 1, 2 * n - 1);
    wall(n, 0);
  }
  return m;
}

/// An extruded convex polygon (x, y), counter-clockwise: fans at both ends, as CAD tessellators make them.
inline TriangleMesh extruded(const Profile& polygon, double z0, double z1) {
  TriangleMesh m;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {z0, z1})
    for (const ProfilePoint& p : polygon) m.vertices.push_back({p.x, p.y, z});
  for (std::uint32_t i = 0; i < n; ++i) add_quad(m, i, (i + 1) % n, n + (i + 1) % n, n + i);
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    m.faces.push_back({{0, i + 1, i}});
    m.faces.push_back({{n, n + i, n + i + 1}});
  }
  return m;
}

/// A regular polygon as a profile, its first corner on the x axis.
inline Profile circle(double radius, std::uint32_t sides) {
  Profile p;
  for (std::uint32_t i = 0; i < sides; ++i)
    p.push_back({radius * std::cos(kTurn * i / sides), radius * std::sin(kTurn * i / sides)});
  return p;
}

/// The points of a square of half size `half` in the directions of a regular polygon's corners.
inline Profile square_around(double half, std::uint32_t sides) {
  Profile p = circle(1, sides);
  for (ProfilePoint& q : p) {
    const double stretch = half / std::max(std::abs(q.x), std::abs(q.y));
    q = {q.x * stretch, q.y * stretch};
  }
  return p;
}

/// A winding surface: where z = pitch * angle / turn + y, the radius is x, for the points (x, y) of a profile that
/// climbs from y = 0 to y = pitch and ends at the radius that it began with.
struct Winding {
  Profile profile;
  double pitch = 1;
  double start = 0;  ///< z at angle 0 of the profile's y = 0.
  std::uint32_t sides = 64;
  std::uint32_t turns = 1;
};

/// The vertices of a winding, column by column along the helix: shape [turns * sides + 1][profile.size() - 1], then the
/// last column's upper neighbours follow from a turn on. `radius` below 0 takes the profile's.
inline void add_winding_vertices(TriangleMesh& m, const Winding& w, double radius) {
  const std::size_t columns = static_cast<std::size_t>(w.turns + 1) * w.sides + 1;
  for (std::size_t i = 0; i < columns; ++i) {
    const double angle = kTurn * static_cast<double>(i % w.sides) / w.sides;
    const double rise = w.start + w.pitch * static_cast<double>(i) / w.sides;
    const bool last_turn = i > static_cast<std::size_t>(w.turns) * w.sides;
    for (std::size_t j = 0; j + 1 < w.profile.size(); ++j) {
      if (last_turn && j > 0) break;  // of the turn above the last one only its lower edge is part of the surface
      const double r = radius < 0 ? w.profile[j].x : radius;
      m.vertices.push_back({r * std::cos(angle), r * std::sin(angle), rise + w.profile[j].y});
    }
  }
}

/// Indices of a winding's vertices.
class WindingIndex {
 public:
  WindingIndex(const Winding& w, std::uint32_t first)
      : rows_(static_cast<std::uint32_t>(w.profile.size()) - 1),
        sides_(w.sides),
        full_(w.turns * w.sides),
        first_(first) {}
  /// Column i along the helix, row j across; row `rows` is row 0 of the next turn.
  std::uint32_t operator()(std::uint32_t i, std::uint32_t j) const {
    if (j == rows_) return (*this)(i + sides_, 0);
    return i <= full_ ? first_ + i * rows_ + j : first_ + (full_ + 1) * rows_ + (i - full_ - 1);
  }
  std::uint32_t rows() const { return rows_; }

 private:
  std::uint32_t rows_, sides_, full_, first_;
};

/// A solid with a winding surface: each end is a fan from the axis to the helix that ends there and the step in it.
inline TriangleMesh wound_solid(const Winding& w) {
  TriangleMesh m;
  add_winding_vertices(m, w, -1);
  const WindingIndex at(w, 0);
  const std::uint32_t columns = w.turns * w.sides, rows = at.rows();
  const auto low = static_cast<std::uint32_t>(m.vertices.size()), high = low + 1;
  m.vertices.push_back({0, 0, w.start - w.pitch});
  m.vertices.push_back({0, 0, w.start + (w.turns + 2) * w.pitch});
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t j = 0; j < rows; ++j) add_quad(m, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  for (std::uint32_t i = 0; i < w.sides; ++i) {
    m.faces.push_back({{low, at(i + 1, 0), at(i, 0)}});
    m.faces.push_back({{at(columns + i, 0), at(columns + i + 1, 0), high}});
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    m.faces.push_back({{low, at(0, j), at(0, j + 1)}});
    m.faces.push_back({{at(columns, j + 1), at(columns, j), high}});
  }
  return m;
}

/// A cylinder of radius `outer` with a winding surface as its hole; its ends follow the winding.
inline TriangleMesh wound_hole(const Winding& w, double outer) {
  TriangleMesh m;
  add_winding_vertices(m, w, outer);
  const WindingIndex out(w, 0), in(w, static_cast<std::uint32_t>(m.vertices.size()));
  add_winding_vertices(m, w, -1);
  const std::uint32_t columns = w.turns * w.sides, rows = out.rows();
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t j = 0; j < rows; ++j) {
      add_quad(m, out(i, j), out(i + 1, j), out(i + 1, j + 1), out(i, j + 1));
      add_quad(m, in(i + 1, j), in(i, j), in(i, j + 1), in(i + 1, j + 1));
    }
  for (std::uint32_t i = 0; i < w.sides; ++i) {
    add_quad(m, out(i + 1, 0), out(i, 0), in(i, 0), in(i + 1, 0));
    const std::uint32_t last = columns + i;
    add_quad(m, out(last, 0), out(last + 1, 0), in(last + 1, 0), in(last, 0));
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    add_quad(m, out(0, j), out(0, j + 1), in(0, j + 1), in(0, j));
    add_quad(m, out(columns, j + 1), out(columns, j), in(columns, j), in(columns, j + 1));
  }
  return m;
}

}  // namespace dismantle::scenes
