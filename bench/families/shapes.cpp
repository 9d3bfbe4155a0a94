// SPDX-License-Identifier: Apache-2.0
#include "bench/families/shapes.h"

#include <map>
#include <utility>

namespace dismantle::families {

namespace {

std::uint32_t add(TriangleMesh& mesh, Vec3 p) {
  mesh.vertices.push_back(p);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

}  // namespace

TriangleMesh gridded_block(const Lines& xs, const Lines& ys, double depth) {
  TriangleMesh m;
  const auto nx = static_cast<std::uint32_t>(xs.size()), ny = static_cast<std::uint32_t>(ys.size());
  for (const double y : ys)
    for (const double x : xs) m.vertices.push_back({x, y, 0});
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * nx + i; };
  for (std::uint32_t j = 0; j + 1 < ny; ++j)
    for (std::uint32_t i = 0; i + 1 < nx; ++i) {
      m.faces.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      m.faces.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  const std::uint32_t low = add(m, {xs.front(), ys.front(), -depth});
  add(m, {xs.back(), ys.front(), -depth});
  add(m, {xs.back(), ys.back(), -depth});
  add(m, {xs.front(), ys.back(), -depth});
  std::vector<std::uint32_t> rims[4];
  for (std::uint32_t i = 0; i < nx; ++i) rims[0].push_back(at(i, 0)), rims[2].push_back(at(nx - 1 - i, ny - 1));
  for (std::uint32_t j = 0; j < ny; ++j) rims[1].push_back(at(nx - 1, j)), rims[3].push_back(at(0, ny - 1 - j));
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t a = low + k, b = low + (k + 1) % 4;
    for (std::size_t i = 0; i + 1 < rims[k].size(); ++i) m.faces.push_back({{a, rims[k][i + 1], rims[k][i]}});
    m.faces.push_back({{a, b, rims[k].back()}});
  }
  m.faces.push_back({{low, low + 2, low + 1}});
  m.faces.push_back({{low, low + 3, low + 2}});
  return m;
}

TriangleMesh spike(int sides, double radius, double height) {
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {0, 0, height}};
  const auto n = static_cast<std::uint32_t>(sides);
  const double turn = 2 * std::acos(-1.0) / sides;
  for (std::uint32_t k = 0; k < n; ++k)
    m.vertices.push_back({radius * std::cos(k * turn), radius * std::sin(k * turn), height});
  for (std::uint32_t k = 0; k < n; ++k) {
    m.faces.push_back({{0, 2 + (k + 1) % n, 2 + k}});
    m.faces.push_back({{1, 2 + k, 2 + (k + 1) % n}});
  }
  return m;
}

TriangleMesh wedge(double half_length, double half_angle, double height) {
  const double l = half_length, b = height * std::tan(half_angle);
  TriangleMesh m;
  m.vertices = {{-l, 0, 0}, {l, 0, 0}, {l, b, height}, {-l, b, height}, {l, -b, height}, {-l, -b, height}};
  m.faces = {{{0, 2, 1}}, {{0, 3, 2}}, {{1, 5, 0}}, {{1, 4, 5}}, {{3, 4, 2}}, {{3, 5, 4}}, {{1, 2, 4}}, {{0, 5, 3}}};
  return m;
}

TriangleMesh waved_sheet(double half, int cells, double waves, double phase) {
  TriangleMesh m;
  const auto n = static_cast<std::uint32_t>(cells);
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = half * (2.0 * i / n - 1), y = half * (2.0 * j / n - 1);
      m.vertices.push_back({x, y, waves * std::sin(3 * x / half + phase) * std::cos(2 * y / half)});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      m.faces.push_back({{a, b, c}});
      m.faces.push_back({{a, c, d}});
    }
  return m;
}

TriangleMesh blind_hole(int sides, double hole, double outer, double bottom, double height) {
  TriangleMesh m;
  const auto n = static_cast<std::uint32_t>(sides);
  const double turn = 2 * std::acos(-1.0) / sides;
  const std::pair<double, double> rings[] = {{outer, 0}, {outer, height}, {hole, height}, {hole, bottom}};
  for (const auto& [r, z] : rings)
    for (std::uint32_t k = 0; k < n; ++k) m.vertices.push_back({r * std::cos(k * turn), r * std::sin(k * turn), z});
  const std::uint32_t low = add(m, {0, 0, 0}), high = add(m, {0, 0, bottom});
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t j = (k + 1) % n;
    for (const std::uint32_t a : {0u, n, 2 * n}) {
      m.faces.push_back({{a + k, a + j, a + n + j}});
      m.faces.push_back({{a + k, a + n + j, a + n + k}});
    }
    m.faces.push_back({{3 * n + k, 3 * n + j, high}});
    m.faces.push_back({{low, j, k}});
  }
  return m;
}

TriangleMesh convex_hull(const std::vector<Vec3>& points) {
  TriangleMesh m;
  m.vertices = points;
  const auto n = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = 0; b < n; ++b)
      for (std::uint32_t c = 0; c < n; ++c) {
        if (a == b || b == c || c == a || a > b || a > c) continue;
        const Vec3 normal = cross(points[b] - points[a], points[c] - points[a]);
        const auto below = [&](const Vec3& p) {
          return &p == &points[a] || &p == &points[b] || &p == &points[c] || dot(p - points[a], normal) < 0;
        };
        if (std::all_of(points.begin(), points.end(), below)) m.faces.push_back({{a, b, c}});
      }
  return m;
}

TriangleMesh ball(int divisions) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh m;
  m.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  m.faces = {{{0, 11, 5}},  {{0, 5, 1}},  {{0, 1, 7}},  {{0, 7, 10}}, {{0, 10, 11}}, {{1, 5, 9}}, {{5, 11, 4}},
             {{11, 10, 2}}, {{10, 7, 6}}, {{7, 1, 8}},  {{3, 9, 4}},  {{3, 4, 2}},   {{3, 2, 6}}, {{3, 6, 8}},
             {{3, 8, 9}},   {{4, 9, 5}},  {{2, 4, 11}}, {{6, 2, 10}}, {{8, 6, 7}},   {{9, 8, 1}}};
  for (int d = 0; d < divisions; ++d) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) at->second = add(m, (m.vertices[a] + m.vertices[b]) / 2);
      return at->second;
    };
    std::vector<Face> faces;
    for (const Face& f : m.faces) {
      const std::uint32_t x = middle(f.v[0], f.v[1]), y = middle(f.v[1], f.v[2]), z = middle(f.v[2], f.v[0]);
      for (const Face& part : {Face{{f.v[0], x, z}}, Face{{f.v[1], y, x}}, Face{{f.v[2], z, y}}, Face{{x, y, z}}})
        faces.push_back(part);
    }
    m.faces = std::move(faces);
  }
  for (Vec3& p : m.vertices) p = normalized(p);
  return m;
}

TriangleMesh cracked(TriangleMesh mesh, int count, double gap, Dice& dice) {
  for (int i = 0; i < count; ++i) {
    const auto f = static_cast<std::size_t>(dice.whole(0, static_cast<int>(mesh.faces.size()) - 1));
    const Face face = mesh.faces[f];
    const Vec3 middle = (mesh.vertices[face.v[0]] + mesh.vertices[face.v[2]]) / 2;
    const std::uint32_t v = add(mesh, middle + dice.uniform(0, gap) * dice.direction());
    mesh.faces[f] = {{face.v[0], face.v[1], v}};
    mesh.faces.push_back({{v, face.v[1], face.v[2]}});
  }
  return mesh;
}

TriangleMesh turned_round(TriangleMesh mesh) {
  for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
  return mesh;
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Face& f : b.faces) a.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
  return a;
}

TriangleMesh shifted(TriangleMesh mesh, Vec3 by) {
  for (Vec3& p : mesh.vertices) p = p + by;
  return mesh;
}

Lines even_lines(double low, double high, int count) {
  Lines lines;
  for (int i = 0; i < count; ++i) lines.push_back(low + (high - low) * i / (count - 1));
  return lines;
}

}  // namespace dismantle::families
