// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/large_scenes.h"
#include "tests/support/puzzle_scenes.h"

#include <map>
#include <random>
#include <string_view>

/// A generator of small assemblies with known answers: all parts can be removed, or none can.
namespace dismantle::scenes {

/// The kinds of cases. Those before ClosedShell come apart, the others are locked.
enum class CaseKind {
  Peg,
  Key,
  Dovetail,
  NestedShells,
  LiddedBox,
  LSlot,
  Hook,
  Bayonet,
  Screw,
  ClosedShell,      ///< A core in a shell without an opening.
  ChainLinks,       ///< Two closed rings, one through the other.
  Rivet,            ///< Both heads are larger than the plate's hole.
  InterlockedBurr,  ///< Three closed rings: no two are linked, all three are (Borromean rings).
};
inline constexpr CaseKind kCaseKinds[] = {
    CaseKind::Peg,   CaseKind::Key,        CaseKind::Dovetail,       CaseKind::NestedShells, CaseKind::LiddedBox,
    CaseKind::LSlot, CaseKind::Hook,       CaseKind::Bayonet,        CaseKind::Screw,        CaseKind::ClosedShell,
    CaseKind::Rivet, CaseKind::ChainLinks, CaseKind::InterlockedBurr};

inline std::string_view name_of(CaseKind kind) {
  constexpr std::string_view kNames[] = {"peg",    "key",   "dovetail",        "nested shells", "lidded box",
                                         "L-slot", "hook",  "bayonet",         "screw",         "closed shell",
                                         "links",  "rivet", "interlocked burr"};
  return kNames[static_cast<std::size_t>(kind)];
}

inline bool comes_apart(CaseKind kind) {
  return kind < CaseKind::ClosedShell;
}

/// The parameters of a case.
struct CaseShape {
  double clearance = 0.1;     ///< [mm]
  double wide = 1, high = 1;  ///< Scale factors across and along z.
  std::uint32_t sides = 24;   ///< Of each cylinder.
};

inline CaseShape random_shape(std::mt19937_64& random) {
  std::uniform_real_distribution<double> clearance(0.02, 0.2), stretch(0.7, 1.5);
  CaseShape shape;
  shape.clearance = clearance(random);
  shape.wide = stretch(random);
  shape.high = stretch(random);
  shape.sides = 16 + 4 * static_cast<std::uint32_t>(random() % 5);
  return shape;
}

/// The first `fixed` components are fixed; all others can be removed, or none can.
struct DisassemblyCase {
  Assembly assembly;
  std::uint32_t fixed = 1;
};

/// A cup that opens upwards, about z: outer radius and wall, from `low` up to `high` [mm].
inline TriangleMesh cup(double radius, double wall, double low, double high, std::uint32_t sides) {
  return revolved(
      {{0, low}, {radius, low}, {radius, high}, {radius - wall, high}, {radius - wall, low + wall}, {0, low + wall}},
      sides);
}

/// Three nested cups.
inline std::vector<Component> nested_shells(double clearance, std::uint32_t sides) {
  std::vector<Component> cups;
  for (int k = 0; k < 3; ++k) {
    const double less = k * (2 + clearance);
    cups.push_back(component("cup " + std::to_string(k), cup(15 - less, 2, less, 20, sides)));
  }
  return cups;
}

/// A box with a lid that reaches into it, and a block under the lid.
inline std::vector<Component> lidded_box(double clearance) {
  const double c = clearance;
  const TriangleMesh base = box_block({{{-14, -12, 12, 14}, {-10, -8, 8, 10}, {0, 2, 12}}},
                                      [](int x, int y, int z) { return x != 1 || y != 1 || z == 0; });
  const TriangleMesh lid = box_block({{{-14, -12 + c, 12 - c, 14}, {-10, -8 + c, 8 - c, 10}, {10, 12, 14}}},
                                     [](int x, int y, int z) { return z == 1 || (x == 1 && y == 1); });
  return {component("base", base), component("lid", lid), component("block", box({-11, -7, 2}, {6, 5, 9}))};
}

/// A rivet through a plate, heads on both sides of it.
inline std::vector<Component> rivet(double clearance, std::uint32_t sides) {
  const TriangleMesh plate = extruded_band(square_around(15, sides), circle(4 + clearance, sides), true, 0, 5);
  const double low = -clearance, high = 5 + clearance;
  const Profile body = {{0, low - 12}, {6, low - 12}, {6, low},       {4, low},
                        {4, high},     {6, high},     {6, high + 12}, {0, high + 12}};
  return {component("plate", plate), component("rivet", revolved(body, sides))};
}

/// Three frames in the three coordinate planes, each around the narrow side of the next and inside the one before.
inline std::vector<Component> interlocked_burr(double clearance) {
  const double half = 5, bar = 2, longer = half + bar + clearance, thick = half - clearance;
  const TriangleMesh frame = box_block(
      {{{-longer - bar, -longer, longer, longer + bar}, {-half - bar, -half, half, half + bar}, {-thick, thick}}},
      [](int x, int y, int) { return x != 1 || y != 1; });
  std::vector<Component> frames;
  for (int k = 0; k < 3; ++k) {
    const Pose turned{{}, quat_about(normalized(Vec3{1, 1, 1}), k * kTurn / 3)};
    frames.push_back(component("frame " + std::to_string(k), moved(frame, turned)));
  }
  return frames;
}

/// A short bolt through a nut of two turns, at least `clearance` between their flanks however the bolt is turned.
inline std::vector<Component> short_screw(double clearance, std::uint32_t sides) {
  constexpr double kRadius = 4, kWhole = 2;  // edges are not cut
  const double sagitta = kRadius * (1 - std::cos(kTurn / 2 / sides));
  Winding bolt = thread(0, kWhole), nut = thread(2 * clearance + sagitta, kWhole);
  bolt.sides = nut.sides = sides;
  bolt.turns = 3;
  bolt.start = -bolt.pitch;
  nut.turns = 2;
  return {component("nut", wound_hole(nut, 7)), component("bolt", wound_solid(bolt))};
}

inline std::vector<Component> components_of(CaseKind kind, const CaseShape& shape) {
  const double c = shape.clearance;
  switch (kind) {
    case CaseKind::Peg:
      return peg_in_hole(shape.sides, c).assembly.components;
    case CaseKind::Key:
      return key_in_slot(c, {0, 1, 0}).assembly.components;
    case CaseKind::Dovetail:
      return dovetail(c).assembly.components;
    case CaseKind::NestedShells:
      return nested_shells(c, shape.sides);
    case CaseKind::LiddedBox:
      return lidded_box(c);
    case CaseKind::LSlot:
      return l_slot(c);
    case CaseKind::Hook:
      return hook(c);
    case CaseKind::Bayonet:
      return bayonet(c);
    case CaseKind::Screw:
      return short_screw(c / 2, shape.sides);
    case CaseKind::ClosedShell:
      return closed_shell().components;
    case CaseKind::Rivet:
      return rivet(c, shape.sides);
    case CaseKind::ChainLinks:
      return chain_links();
    case CaseKind::InterlockedBurr:
      return interlocked_burr(c);
  }
  return {};
}

inline DisassemblyCase disassembly_case(CaseKind kind, const CaseShape& shape) {
  DisassemblyCase made{assembly(components_of(kind, shape)), 1};
  if (kind == CaseKind::Hook) made.fixed = 3;
  for (Component& c : made.assembly.components) {
    TriangleMesh mesh = *c.mesh;
    for (Vec3& p : mesh.vertices) p = {shape.wide * p.x, shape.wide * p.y, shape.high * p.z};
    c.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  }
  return made;
}

/// The same surface with more triangles: edges chosen at random are halved.
inline TriangleMesh refined(const TriangleMesh& mesh, std::mt19937_64& random) {
  TriangleMesh fine{mesh.vertices, {}};
  constexpr std::uint32_t kWhole = 0xffffffffu;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), kWhole);
    if (fresh && random() % 2 == 0) {
      found->second = static_cast<std::uint32_t>(fine.vertices.size());
      fine.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    }
    return found->second;
  };
  for (const Face& face : mesh.faces) {
    std::vector<Face> parts{face};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = face.v[k], b = face.v[(k + 1) % 3], m = middle(a, b);
      if (m == kWhole) continue;
      // One part has the edge.
      for (std::size_t p = 0, count = parts.size(); p < count; ++p)
        for (int i = 0; i < 3; ++i) {
          const Face part = parts[p];
          if (part.v[i] != a || part.v[(i + 1) % 3] != b) continue;
          const std::uint32_t opposite = part.v[(i + 2) % 3];
          parts[p] = {{a, m, opposite}};
          parts.push_back({{m, b, opposite}});
        }
    }
    fine.faces.insert(fine.faces.end(), parts.begin(), parts.end());
  }
  return fine;
}

/// The assembly with refined meshes.
inline Assembly refined(const Assembly& assembly, std::mt19937_64& random) {
  Assembly other = assembly;
  for (Component& c : other.components) c.mesh = std::make_shared<const TriangleMesh>(refined(*c.mesh, random));
  return other;
}

}  // namespace dismantle::scenes
