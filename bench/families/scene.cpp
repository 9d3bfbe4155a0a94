// SPDX-License-Identifier: Apache-2.0
#include "bench/families/scene.h"

#include "bench/families/shapes.h"

#include <utility>

namespace dismantle::families {

namespace {

constexpr double kPi = 3.14159265358979323846;
const Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

double some_tolerance(Dice& dice) {
  return dice.chance(0.4) ? 0.01 : dice.spread(0.001, 0.05);
}

/// How far apart two parts begin: apart, exactly touching, or overlapping by less than the tolerance.
double some_gap(Dice& dice, double tolerance) {
  const double kind = dice.uniform(0, 1);
  if (kind < 0.5) return dice.spread(0.1 * tolerance, 2);
  if (kind < 0.7) return 0;
  return kind < 0.85 ? -dice.uniform(0, 0.9) * tolerance : dice.uniform(0, 0.9) * tolerance;
}

/// A few micrometres off, or not at all.
Vec3 some_offset(Dice& dice) {
  return dice.chance(0.3) ? Vec3{} : dice.spread(1e-6, 5e-3) * dice.direction();
}

TriangleMesh some_floor(Dice& dice, double half) {
  const int kind = dice.whole(0, 2);
  if (kind == 0) return scenes::tube(half, 0, -5, 0, static_cast<std::uint32_t>(dice.whole(3, 40)));
  const int n = dice.whole(2, 9);
  return gridded_block(even_lines(-half, half, n), even_lines(-half, half, kind == 1 ? n : dice.whole(2, 9)), 5);
}

/// A point of the floor: a vertex, the middle of an edge, or anywhere.
Vec3 some_place(Dice& dice, const TriangleMesh& floor) {
  for (int tries = 0; tries < 1000; ++tries) {
    const Face& f = floor.faces[static_cast<std::size_t>(dice.whole(0, static_cast<int>(floor.faces.size()) - 1))];
    const Vec3 a = floor.vertices[f.v[0]], b = floor.vertices[f.v[1]], c = floor.vertices[f.v[2]];
    if (a.z != 0 || b.z != 0 || c.z != 0) continue;
    const double kind = dice.uniform(0, 1), u = dice.uniform(0, 1), v = dice.uniform(0, 1 - u);
    const Vec3 p = kind < 0.35 ? a : kind < 0.75 ? a + u * (b - a) : a + u * (b - a) + v * (c - a);
    if (std::max(std::abs(p.x), std::abs(p.y)) < 4) return p;
  }
  return {};
}

TriangleMesh tilted(TriangleMesh mesh, Vec3 about, double angle) {
  return scenes::moved(std::move(mesh), {{}, quat_about(about, angle)});
}

TriangleMesh turned(TriangleMesh mesh, Dice& dice) {
  return tilted(std::move(mesh), kUp, dice.chance(0.5) ? 0 : dice.uniform(0, 6));
}

double lowest(const TriangleMesh& mesh) {
  return bounds(mesh).lower.z;
}

/// A part above a floor: it meets the floor at a vertex or edge or so.
Scene above_floor(Dice& dice, std::string name, TriangleMesh mesh, TriangleMesh floor) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  scene.gap = some_gap(dice, scene.tolerance);
  scene.toward = kDown;
  scene.exits = {kUp};
  scene.size = diagonal(bounds(mesh));
  if (dice.chance(0.3))
    mesh = tilted(std::move(mesh), normalized(Vec3{dice.direction().x, 1, 0}), dice.uniform(-0.5, 0.5));
  Vec3 place = some_place(dice, floor) + some_offset(dice);
  place.z = scene.gap - lowest(mesh);
  scene.parts = {{std::move(name), shifted(std::move(mesh), place), true}, {"floor", std::move(floor), true}};
  return scene;
}

Scene needles(Dice& dice) {
  const double height = dice.uniform(2, 10), half_angle = dice.spread(0.5, 20) * kPi / 180;
  return above_floor(dice, "needle", turned(spike(dice.whole(3, 6), height * std::tan(half_angle), height), dice),
                     some_floor(dice, 6));
}

Scene cones(Dice& dice) {
  const double height = dice.uniform(1, 5), half_angle = dice.spread(3, 75) * kPi / 180;
  const int sides = static_cast<int>(dice.spread(7, 200));
  return above_floor(dice, "cone", turned(spike(sides, height * std::tan(half_angle), height), dice),
                     some_floor(dice, 6));
}

Scene knives(Dice& dice) {
  const double length = dice.uniform(1, 12), height = dice.uniform(2, 6), angle = dice.spread(0.5, 30) * kPi / 180;
  TriangleMesh knife = wedge(length / 2, angle, height);
  const double turns[] = {0, kPi / 2, kPi / 4, dice.uniform(0, 3)};
  return above_floor(dice, "knife", tilted(std::move(knife), kUp, turns[dice.whole(0, 3)]), some_floor(dice, 6));
}

/// Spikes on a mesh that is finer or coarser there than the tolerance.
Scene spikes(Dice& dice) {
  const double cell = dice.spread(2e-4, 1);
  const int n = dice.whole(4, 12);
  const auto lines = [&] {
    Lines all = even_lines(-cell * n / 2, cell * n / 2, n + 1);
    all.insert(all.begin(), -6);
    all.push_back(6);
    return all;
  };
  const TriangleMesh floor = gridded_block(lines(), lines(), dice.uniform(0.5, 5));
  const double height = dice.uniform(1, 6);
  TriangleMesh all = spike(dice.whole(3, 8), height * dice.spread(0.02, 0.5), height);
  for (int k = dice.whole(0, 3); k > 0; --k) {
    const Vec3 by{dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), dice.uniform(0, 0.02)};
    all = together(all, shifted(spike(dice.whole(3, 8), height * dice.spread(0.02, 0.5), height - by.z), by));
  }
  Scene scene = above_floor(dice, "spikes", all, floor);
  scene.parts.front().simple = false;
  return scene;
}

TriangleMesh rod(Dice& dice, double radius, double half) {
  const auto sides = static_cast<std::uint32_t>(dice.spread(8, 1001));
  return turned(scenes::tube(radius, 0, -half, half, sides, 1), dice);
}

/// Two rods that cross: apart, touching, or one through the other.
Scene rods(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  const double r = dice.uniform(0.5, 3), s = dice.uniform(0.5, 3);
  const bool through = dice.chance(0.35);
  scene.gap = through ? -dice.spread(2 * scene.tolerance, 2 * std::min(r, s)) : some_gap(dice, scene.tolerance);
  const double angle = dice.chance(0.5) ? kPi / 2 : dice.uniform(0.1, kPi / 2);
  TriangleMesh a = tilted(rod(dice, r, 10), {1, 0, 0}, kPi / 2), b = tilted(rod(dice, s, 10), {1, 0, 0}, kPi / 2);
  a = tilted(std::move(a), kUp, angle);
  scene.parts = {{"a", shifted(std::move(a), {dice.uniform(-2, 2), 0, r + s + scene.gap}), true},
                 {"b", std::move(b), true}};
  scene.toward = kDown;
  scene.size = 20;
  scene.exits = {kUp};
  return scene;
}

TriangleMesh some_sheet(Dice& dice, double half) {
  TriangleMesh sheet =
      waved_sheet(half, dice.whole(1, 8), dice.chance(0.6) ? 0 : dice.spread(0.01, 1), dice.uniform(0, 6));
  if (dice.chance(0.5)) sheet = turned_round(std::move(sheet));
  const int kind = dice.whole(0, 3);
  if (kind == 1) sheet = tilted(std::move(sheet), {1, 0, 0}, kPi / 2);
  if (kind == 2) sheet = tilted(std::move(sheet), dice.direction(), dice.uniform(0, 3));
  return turned(std::move(sheet), dice);
}

Scene sheets(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  scene.gap = some_gap(dice, scene.tolerance);
  TriangleMesh sheet = some_sheet(dice, dice.uniform(1, 4));
  scene.size = diagonal(bounds(sheet));
  Part other{"other", {}, true};
  const int kind = dice.whole(0, 3);
  if (kind == 0) {
    other.mesh = waved_sheet(5, dice.whole(1, 8), 0, 0);
    other.solid = false;
  } else if (kind == 1) {
    other.mesh = shifted(ball(2), {0, 0, -1});
    other.mesh = tilted(std::move(other.mesh), kUp, dice.uniform(0, 1));
  } else {
    other.mesh = some_floor(dice, 5);
  }
  if (!other.solid && dice.chance(0.5)) other.mesh = turned_round(other.mesh);
  const double top = bounds(other.mesh).upper.z;
  Vec3 place = kind == 1 ? some_offset(dice) : some_place(dice, other.mesh) + some_offset(dice);
  place.z = top + scene.gap - lowest(sheet);
  Part own{"sheet", shifted(std::move(sheet), place), false};
  scene.toward = kDown;
  scene.exits = {kUp};
  if (dice.chance(0.5)) {
    scene.parts = {std::move(own), std::move(other)};
  } else {
    scene.parts = {std::move(other), std::move(own)};
    scene.toward = kUp;
    scene.exits = {kDown};
    scene.size = 10;
  }
  return scene;
}

Scene foils(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  scene.gap = some_gap(dice, scene.tolerance);
  const double thick = dice.spread(0.1, 10) * scene.tolerance;
  const Lines lines = even_lines(-5, 5, dice.whole(2, 6));
  TriangleMesh foil = gridded_block(lines, lines, thick);
  TriangleMesh weight;
  const int kind = dice.whole(0, 4);
  if (kind == 0) weight = scenes::box({-1, -1, 0}, {1, 1, 2});
  if (kind == 1) weight = spike(dice.whole(3, 20), 1, dice.spread(0.3, 5));
  if (kind == 2) weight = ball(2);
  if (kind == 3) weight = wedge(2, dice.uniform(0.01, 0.5), 2);
  if (kind == 4) weight = gridded_block({-2, 2}, {-2, 0, 2}, dice.spread(0.1, 10) * scene.tolerance);
  if (dice.chance(0.3)) weight = tilted(std::move(weight), dice.direction(), dice.uniform(0, 3));
  scene.size = diagonal(bounds(weight));
  Vec3 place = some_place(dice, foil) + some_offset(dice);
  place.z = scene.gap - lowest(weight);
  scene.parts = {{"weight", shifted(std::move(weight), place), true}, {"foil", std::move(foil), true}};
  scene.toward = kDown;
  scene.exits = {kUp};
  return scene;
}

double sagitta(double radius, std::size_t sides) {
  return radius * (1 - std::cos(kPi / static_cast<double>(sides)));
}

Scene blind_holes(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  const int sides = static_cast<int>(dice.spread(8, 200));
  const double r = dice.uniform(1, 5), fit = dice.uniform(-2, 8) * scene.tolerance, bottom = dice.uniform(1, 5);
  const double height = bottom + dice.uniform(2, 10), from = bottom + dice.uniform(0, 1) * (height - bottom);
  const bool same = dice.chance(0.6);
  const auto peg_sides = static_cast<std::uint32_t>(same ? sides : static_cast<int>(dice.spread(8, 200)));
  TriangleMesh peg = scenes::tube(r + fit, 0, from, from + 10, peg_sides, static_cast<std::uint32_t>(dice.whole(1, 2)));
  if (dice.chance(0.4)) peg = tilted(std::move(peg), kUp, kPi / sides * dice.uniform(0, 1));
  scene.parts = {{"peg", std::move(peg), true}, {"hole", blind_hole(sides, r, r + 3, bottom, height), true}};
  scene.sagittas = sagitta(r, static_cast<std::size_t>(sides)) + sagitta(r, peg_sides);
  scene.toward = kDown;
  scene.gap = from - bottom;
  scene.exits = {kUp};
  scene.size = 10;
  return scene;
}

/// Solids with cracks and T-junctions.
Scene cracks(Dice& dice) {
  Scene scene;
  const int kind = dice.whole(0, 3);
  if (kind == 0) scene = blind_holes(dice);
  if (kind == 1) scene = rods(dice);
  if (kind == 2) scene = needles(dice);
  if (kind == 3)
    scene = above_floor(dice, "box", turned(scenes::box({-1, -1, 0}, {1, 1, 2}), dice), some_floor(dice, 6));
  const double gap = dice.chance(0.5) ? 0 : dice.spread(1e-9, 0.3 * scene.tolerance);
  for (Part& part : scene.parts)
    if (dice.chance(0.8)) part.mesh = cracked(std::move(part.mesh), dice.whole(1, 6), gap, dice);
  return scene;
}

TriangleMesh scaled(TriangleMesh mesh, double by) {
  for (Vec3& p : mesh.vertices) p = by * p;
  return mesh;
}

TriangleMesh shell_core(Dice& dice, int kind, double size) {
  if (kind == 0) return scenes::box({-size, -size, -size}, {size, size, size});
  if (kind == 1) return scaled(ball(dice.whole(1, 3)), size);
  return scenes::tube(size, 0, -size, size, static_cast<std::uint32_t>(dice.whole(5, 60)));
}

/// A core inside a closed shell: it cannot leave.
Scene shells(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  const int kind = dice.whole(0, 2);
  const double size = dice.uniform(1, 4), wall = dice.spread(0.3 * scene.tolerance, 1);
  const double fit = dice.chance(0.3)   ? 0
                     : dice.chance(0.5) ? dice.spread(1e-3, 1)
                                        : dice.uniform(-3, 3) * scene.tolerance;
  std::mt19937_64 same = dice.random;
  Dice again{same};
  const TriangleMesh hollow = shell_core(again, kind, size);
  TriangleMesh core = shell_core(dice, kind, size);
  for (Vec3& p : core.vertices) p = (1 - fit / size) * p;
  if (kind == 2) scene.sagittas = 2 * sagitta(size, hollow.faces.size() / 4);
  TriangleMesh outer = hollow;
  for (Vec3& p : outer.vertices) p = (1 + wall / size) * p;
  scene.parts = {{"core", std::move(core), true}, {"shell", together(std::move(outer), turned_round(hollow)), true}};
  scene.toward = dice.direction();
  scene.gap = std::max(fit, 0.0);
  scene.size = 2 * size;
  return scene;
}

TriangleMesh some_polyhedron(Dice& dice) {
  if (dice.chance(0.5)) {
    std::vector<Vec3> points;
    for (int i = dice.whole(4, 14); i > 0; --i) points.push_back(dice.uniform(0.6, 1) * dice.direction());
    TriangleMesh hull = convex_hull(points);
    if (hull.faces.size() >= 4) return hull;
  }
  TriangleMesh star = ball(dice.whole(0, 2));
  const double rough = dice.uniform(0, 0.8);
  for (Vec3& p : star.vertices) p = dice.uniform(1 - rough, 1) * p;
  return star;
}

Scene tumbling(Dice& dice) {
  Scene scene;
  scene.tolerance = some_tolerance(dice);
  const double big = dice.uniform(1, 3);
  TriangleMesh a = some_polyhedron(dice), b = scaled(some_polyhedron(dice), big);
  scene.gap = dice.chance(0.25) ? -dice.spread(1e-3, 0.6) : some_gap(dice, scene.tolerance);
  a = shifted(std::move(a), {dice.uniform(-0.5, 0.5), dice.uniform(-0.5, 0.5), 0});
  const double rise = bounds(b).upper.z + scene.gap - lowest(a);
  a = shifted(std::move(a), {0, 0, rise});
  scene.parts = {{"a", std::move(a), true}, {"b", std::move(b), true}};
  scene.toward = kDown;
  scene.size = 2;
  scene.exits = {kUp};
  return scene;
}

}  // namespace

Scene make_scene(std::size_t family, std::mt19937_64& random) {
  Dice dice{random};
  using Make = Scene (*)(Dice&);
  constexpr Make kMakers[kFamilyCount] = {needles, cones,  knives, spikes,      rods,    sheets,
                                          foils,   cracks, shells, blind_holes, tumbling};
  Scene scene = kMakers[family](dice);
  if (dice.chance(0.5)) return scene;
  const Pose pose{{dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-5, 5)},
                  quat_about(dice.direction(), dice.uniform(0, 3))};
  const Mat3 turn = mat3_from_quat(pose.rotation);
  for (Part& part : scene.parts) part.mesh = scenes::moved(std::move(part.mesh), pose);
  scene.toward = turn * scene.toward;
  for (Vec3& exit : scene.exits) exit = turn * exit;
  return scene;
}

}  // namespace dismantle::families
