// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/slide_scenes.h"

#include <random>

/// Close fits with a given number of triangles, for benchmarks.
namespace dismantle::scenes {

inline std::uint32_t at_least(double count, std::uint32_t minimum) {
  return std::max(minimum, static_cast<std::uint32_t>(std::lround(count)));
}

/// A shaft of radius 10 - clearance in a housing with a bore of radius 10, 100 long; triangles as long as wide.
inline SlideScene shaft_in_hole(std::size_t triangles, double clearance) {
  // The housing has four walls' worth of 2 * sides * rings / 2 triangles, the shaft one: 6 * sides * rings in all.
  const double share = static_cast<double>(triangles) / 6;
  const std::uint32_t sides = at_least(std::sqrt(share * kTurn * 10 / 100), 8);
  const std::uint32_t rings = at_least(share / sides, 1);
  return slide_scene({component("housing", tube(20, 10, 0, 100, sides, rings)),
                      component("shaft", tube(10 - clearance, 0, 0, 100, sides, rings))},
                     {0, 0, 1}, 100);
}

/// A torus of radii 30 and 5 about z, and a thin ring that it goes through, `clearance` wider; the ring moves.
inline SlideScene ring_on_torus(std::size_t triangles, double clearance) {
  // The torus has four fifths of all triangles.
  const std::uint32_t around = at_least(std::sqrt(static_cast<double>(triangles) * 0.4 * 30 / 5), 24);
  const std::uint32_t across = at_least(static_cast<double>(triangles) * 0.4 / around, 12);
  const std::uint32_t ring_around = at_least(std::sqrt(static_cast<double>(triangles) * 0.1 * 7), 24);
  const std::uint32_t ring_across = at_least(static_cast<double>(triangles) * 0.1 / ring_around, 8);
  const auto torus = [](double large, double small, std::uint32_t sides, std::uint32_t points) {
    Profile loop = circle(small, points);
    for (ProfilePoint& p : loop) p.x += large;
    return revolved_loop(loop, sides);
  };
  const Pose upright{{30, 0, 0}, quat_about({1, 0, 0}, kTurn / 4)};
  return slide_scene({component("torus", torus(30, 5, around, across)),
                      component("ring", moved(torus(6 + clearance, 1, ring_around, ring_across), upright))},
                     {0, 1, 0}, 30);
}

/// A peg in a bore, meshed as CAD tessellators do: strips as long as the bore, fans as wide as the faces.
inline SlideScene sliver_peg(std::size_t triangles, double clearance) {
  // The peg with its shoulder has 10 triangles per side, the block 8.
  return peg_in_hole(at_least(static_cast<double>(triangles) / 18 / 8, 3) * 8, clearance);
}

/// An M8 thread: pitch 1.25 mm, flanks at 30 degrees, flats at the crests and roots; `wider` in radius.
inline Winding thread(double wider, double edge_length) {
  const double pitch = 1.25, high = 4, deep = pitch * 5 / 16 / std::tan(kTurn / 12);
  const Profile corners = {{high - deep + wider, 0},
                           {high - deep + wider, pitch / 4},
                           {high + wider, pitch * 9 / 16},
                           {high + wider, pitch * 11 / 16},
                           {high - deep + wider, pitch}};
  Winding w;
  w.pitch = pitch;
  w.profile = subdivided(corners, edge_length, false);
  return w;
}

/// The surface of a winding (outer, or inner seen from within), open at its ends, with other vertices: they lie
/// anywhere on it, so that no edges run along helices. @param rows of vertices per turn
inline TriangleMesh with_other_vertices(const Winding& w, bool inner, std::uint32_t rows, std::mt19937_64& random) {
  std::uniform_real_distribution<double> off(-0.35, 0.35);
  const auto on_profile = [&](double share) {
    std::size_t j = 1;
    while (j + 1 < w.profile.size() && w.profile[j].y < share * w.pitch) ++j;
    const ProfilePoint a = w.profile[j - 1], b = w.profile[j];
    return a.x + (b.x - a.x) * (share * w.pitch - a.y) / (b.y - a.y);
  };
  TriangleMesh m;
  const std::uint32_t across = w.turns * rows;  // once around the last column is a turn above the first
  for (std::uint32_t i = 0; i < w.sides; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const double turn = (i + off(random)) / w.sides, up = (j + off(random)) / rows, whole = std::floor(up);
      const double r = on_profile(up - whole), angle = kTurn * turn;
      m.vertices.push_back({r * std::cos(angle), r * std::sin(angle), w.start + w.pitch * (turn + up)});
    }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m.faces.push_back(inner ? Face{{a, c, b}} : Face{{a, b, c}});
  };
  for (std::uint32_t i = 0; i < w.sides; ++i)
    for (std::uint32_t j = 0; j + 1 + (i + 1 == w.sides ? rows : 0) <= across; ++j) {
      const std::uint32_t here = i * (across + 1) + j;
      const std::uint32_t next = i + 1 < w.sides ? here + across + 1 : j + rows;
      add(here, next, next + 1);
      add(here, next + 1, here + 1);
    }
  return m;
}

/// A threaded bolt of 16 turns in a nut of 5, `clearance` between their flanks; the bolt moves, out by screwing.
inline SlideScene bolt_in_nut(std::size_t triangles, double clearance) {
  // The bolt's surface is 32 times, the nut's two 20 times sides * rows triangles.
  const double cells = static_cast<double>(triangles) / 52;
  const double edge_length = 2.2 / std::sqrt(cells / 12);
  Winding bolt = thread(0, edge_length), nut = thread(2 * clearance, edge_length);
  bolt.sides = nut.sides = at_least(cells / static_cast<double>(bolt.profile.size() - 1), 16);
  bolt.turns = 16;
  bolt.start = -5 * bolt.pitch;
  nut.turns = 5;
  return slide_scene({component("nut", wound_hole(nut, 7)), component("bolt", wound_solid(bolt))}, {0, 0, 1},
                     12 * 1.25);
}

/// The bolt's pose after it has been turned by `angle` [rad] out of the nut.
inline Pose unscrewed(double angle) {
  return {{0, 0, 1.25 * angle / kTurn}, quat_about({0, 0, 1}, angle)};
}

/// Two gears with about that many triangles.
inline GearPair large_gear_pair(std::size_t triangles, double backlash) {
  GearPair pair = gear_pair(backlash);
  // 50 teeth of 2 * points corners, each with 4 triangles a layer and 4 at the ends.
  const double cells = static_cast<double>(triangles) / 400;
  for (Gear* gear : {&pair.fixed, &pair.moving}) {
    gear->points = at_least(std::sqrt(cells), 3);
    gear->layers = at_least(cells / gear->points - 1, 1);
  }
  return pair;
}

}  // namespace dismantle::scenes
