// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/math/angle.h"

#include <cmath>
#include <functional>
#include <vector>

namespace dismantle::scenes {

/// The distance from the axis of an outline by the angle about it.
using Outline = std::function<double(double)>;

inline Outline circle(double radius) {
  return [radius](double) { return radius; };
}

inline Outline hexagon(double across_flats) {
  return [across_flats](double angle) {
    const double sixth = kTurn / 6, off = angle - sixth * std::round(angle / sixth);
    return across_flats / 2 / std::cos(off);
  };
}

/// Lobes: the radius goes between two values so many times per turn.
inline Outline lobes(double smallest, double largest, int count) {
  return [=](double angle) { return smallest + (largest - smallest) * (0.5 + 0.5 * std::cos(count * angle)); };
}

/// An outline at a height.
struct Ring {
  double z = 0;     ///< [mm]
  Outline outline;  ///< [mm]
};

/// A solid about z that is turned from rings one after another, with a point of the axis at both ends if `closed`, or
/// else with the last ring joined to the first: a ring. Outlines are sampled at 48 angles, corners of hexagons among
/// them.
inline TriangleMesh turned(const std::vector<Ring>& rings, bool closed = true) {
  constexpr std::uint32_t kSides = 48;
  TriangleMesh m;
  const auto count = static_cast<std::uint32_t>(rings.size());
  for (const Ring& ring : rings)
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double angle = kTurn * k / kSides, r = ring.outline(angle);
      m.vertices.push_back({r * std::cos(angle), r * std::sin(angle), ring.z});
    }
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t next = (k + 1) % kSides, a0 = a * kSides + k, a1 = a * kSides + next, b0 = b * kSides + k,
                          b1 = b * kSides + next;
      m.faces.push_back({{a0, a1, b1}});
      m.faces.push_back({{a0, b1, b0}});
    }
  };
  for (std::uint32_t i = 0; i + 1 < count; ++i) join(i, i + 1);
  if (!closed) {
    join(count - 1, 0);
    return m;
  }
  const auto bottom = static_cast<std::uint32_t>(m.vertices.size());
  m.vertices.push_back({0, 0, rings.front().z});
  m.vertices.push_back({0, 0, rings.back().z});
  for (std::uint32_t k = 0; k < kSides; ++k) {
    const std::uint32_t next = (k + 1) % kSides, last = (count - 1) * kSides;
    m.faces.push_back({{bottom, next, k}});
    m.faces.push_back({{bottom + 1, last + k, last + next}});
  }
  return m;
}

/// A screw with its tip down, at z = -length: shank, round or hexagonal head above z = 0, recess.
inline TriangleMesh screw(double diameter, double length, const Outline& head, double height,
                          const Outline& recess = circle(0.2), double depth = 0) {
  std::vector<Ring> rings{{-length, circle(0.45 * diameter)},
                          {-length + 0.1 * diameter, circle(diameter / 2)},
                          {0, circle(diameter / 2)},
                          {0, head},
                          {height, head}};
  if (depth > 0) {
    rings.push_back({height, recess});
    rings.push_back({height - depth, recess});
  }
  return turned(rings);
}

}  // namespace dismantle::scenes
