// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/congruence.h"

#include "dismantle/core/span.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace dismantle {

namespace {

/// A first motion rests on two vertices, and is corrected before the tolerance is applied; until then vertices may be
/// this many tolerances apart.
constexpr double kLoose = 8;
/// The two vertices are no nearer to the center than this share of the farthest, and seen from it at no smaller sine.
constexpr double kFar = 0.5, kMinSine = 0.3;
/// Pairs of vertices that are examined, at most.
constexpr std::size_t kMaxPairs = 4'000'000;
/// Motions that are verified, at most.
constexpr std::size_t kMaxMotions = 20'000;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Finds the vertex at a place.
class VertexGrid {
 public:
  VertexGrid(Span<const Vec3> vertices, double cell) : vertices_(vertices), cell_(cell) {
    cells_.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) cells_.emplace(key(coordinates(vertices[v])), v);
  }

  /// The nearest vertex that is not `used`, within half a cell; nothing if there is none.
  std::optional<std::uint32_t> nearest(Vec3 p, double within, const std::vector<bool>& used) const {
    std::optional<std::uint32_t> found;
    double best = within * within;
    const auto low = coordinates(p - Vec3{within, within, within}),
               high = coordinates(p + Vec3{within, within, within});
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto [first, last] = cells_.equal_range(key({x, y, z}));
          for (auto at = first; at != last; ++at) {
            const double square = length_squared(vertices_[at->second] - p);
            if (square > best || used[at->second]) continue;
            best = square;
            found = at->second;
          }
        }
    return found;
  }

 private:
  std::array<std::int64_t, 3> coordinates(Vec3 p) const {
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
    return {at(p.x), at(p.y), at(p.z)};
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
    std::uint64_t hash = 0;
    for (const std::int64_t x : c) hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u + (hash >> 29);
    return hash;
  }

  Span<const Vec3> vertices_;
  double cell_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// The indices whose distances from the center are within `play` of one.
std::vector<std::uint32_t> at_distance(Span<const double> distances, double wanted, double play) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t v = 0; v < distances.size(); ++v)
    if (std::abs(distances[v] - wanted) <= play) found.push_back(v);
  return found;
}

/// True if the faces that only one mesh has are plane polygons: those that meet at edges that the other mesh does not
/// have lie in one plane within the tolerance.
bool are_plane_polygons(Span<const Vec3> vertices, const std::vector<Face>& faces, const std::map<Edge, int>& shared,
                        double within) {
  std::vector<std::uint32_t> parent(faces.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  std::map<Edge, std::uint32_t> first_of;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Edge edge = std::minmax(faces[f].v[k], faces[f].v[(k + 1) % 3]);
      if (shared.count(edge) > 0) continue;
      const auto [at, is_new] = first_of.try_emplace(edge, f);
      if (!is_new) parent[root(f)] = root(at->second);
    }
  std::map<std::uint32_t, std::vector<std::uint32_t>> polygons;
  for (std::uint32_t f = 0; f < faces.size(); ++f) polygons[root(f)].push_back(f);
  return std::all_of(polygons.begin(), polygons.end(), [&](const auto& polygon) {
    Vec3 normal;
    for (const std::uint32_t f : polygon.second)
      normal += normal_unscaled(Triangle{{vertices[faces[f].v[0]], vertices[faces[f].v[1]], vertices[faces[f].v[2]]}});
    normal = normalized(normal);
    const Vec3 origin = vertices[faces[polygon.second.front()].v[0]];
    return std::all_of(polygon.second.begin(), polygon.second.end(), [&](std::uint32_t f) {
      return std::all_of(std::begin(faces[f].v), std::end(faces[f].v),
                         [&](std::uint32_t v) { return std::abs(dot(vertices[v] - origin, normal)) <= within; });
    });
  });
}

std::map<Edge, int> edges_of(const std::vector<Face>& faces) {
  std::map<Edge, int> edges;
  for (const Face& f : faces)
    for (int k = 0; k < 3; ++k) ++edges[std::minmax(f.v[k], f.v[(k + 1) % 3])];
  return edges;
}

/// The face with its smallest vertex first.
Face rotated(Face f) {
  while (f.v[0] > f.v[1] || f.v[0] > f.v[2]) f = {{f.v[1], f.v[2], f.v[0]}};
  return f;
}

/// True if two lists of faces over the same vertices are one surface.
bool same_surface(Span<const Vec3> vertices, std::vector<Face> a, std::vector<Face> b, double within) {
  const auto before = [](const Face& x, const Face& y) {
    return std::lexicographical_compare(std::begin(x.v), std::end(x.v), std::begin(y.v), std::end(y.v));
  };
  for (auto* faces : {&a, &b}) {
    std::transform(faces->begin(), faces->end(), faces->begin(), rotated);
    std::sort(faces->begin(), faces->end(), before);
  }
  std::vector<Face> only_a, only_b;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_a), before);
  std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(only_b), before);
  if (only_a.empty() && only_b.empty()) return true;
  std::map<Edge, int> boundary;
  const auto add = [&](const std::vector<Face>& faces, int sign) {
    for (const Face& f : faces)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = f.v[k], to = f.v[(k + 1) % 3];
        boundary[std::minmax(from, to)] += from < to ? sign : -sign;
      }
  };
  add(only_a, 1);
  add(only_b, -1);
  if (std::any_of(boundary.begin(), boundary.end(), [](const auto& edge) { return edge.second != 0; })) return false;
  return are_plane_polygons(vertices, only_a, edges_of(only_b), within) &&
         are_plane_polygons(vertices, only_b, edges_of(only_a), within);
}

/// The inverse of a symmetric positive definite matrix times a vector.
Vec3 solved(const Mat3& m, Vec3 v) {
  const double det = determinant(m);
  return Vec3{dot(cross(m.row[1], m.row[2]), v), dot(cross(m.row[2], m.row[0]), v), dot(cross(m.row[0], m.row[1]), v)} /
         det;
}

/// The rotation by a vector: its direction is the axis, its length the angle [rad].
Mat3 rotation_by(Vec3 v) {
  const double angle = length(v);
  if (!(angle > 0)) return {};
  const Vec3 axis = v / angle;
  const double s = std::sin(angle), c = std::cos(angle);
  Mat3 m;
  for (int i = 0; i < 3; ++i) {
    Vec3 e;
    e[i] = 1;
    // Column i of the rotation is that of e; the transposed matrix is made by rows.
    m.row[i] = c * e + s * cross(axis, e) + ((1 - c) * dot(axis, e)) * axis;
  }
  return transposed(m);
}

/// Searches the motion of one mesh onto another.
class CongruenceSearch {
 public:
  CongruenceSearch(const TriangleMesh& a, const MeshInvariants& of_a, const TriangleMesh& b, const MeshInvariants& of_b)
      : a_(a),
        b_(b),
        center_a_(of_a.center),
        center_b_(of_b.center),
        within_(2 * kCongruenceTolerance * std::max(of_a.reach, of_b.reach)),
        grid_(b.vertices, 2 * kLoose * within_),
        sorted_(of_a.distances) {
    for (const Vec3& p : a.vertices) distances_a_.push_back(length(p - center_a_));
    for (const Vec3& p : b.vertices) distances_b_.push_back(length(p - center_b_));
  }

  std::optional<RigidTransform> run() {
    const auto landmarks = choose_landmarks();
    if (!landmarks) return std::nullopt;
    const Vec3 first = a_.vertices[landmarks->first] - center_a_, second = a_.vertices[landmarks->second] - center_a_;
    const double apart = length(first - second);
    const std::vector<std::uint32_t> firsts = at_distance(distances_b_, length(first), within_);
    const std::vector<std::uint32_t> seconds = at_distance(distances_b_, length(second), within_);
    const Mat3 frame_a = frame_of(first, second);
    std::size_t pairs = 0, motions = 0;
    for (const std::uint32_t x : firsts)
      for (const std::uint32_t y : seconds) {
        if (++pairs > kMaxPairs) return std::nullopt;
        if (std::abs(length(b_.vertices[x] - b_.vertices[y]) - apart) > 2 * within_) continue;
        if (++motions > kMaxMotions) return std::nullopt;
        const Mat3 turn = transposed(frame_of(b_.vertices[x] - center_b_, b_.vertices[y] - center_b_)) * frame_a;
        if (const auto motion = verified({turn, center_b_ - turn * center_a_})) return motion;
      }
    return std::nullopt;
  }

 private:
  /// Number of vertices of `a` that are as far from the center.
  std::size_t alike(std::uint32_t v) const {
    const auto low = std::lower_bound(sorted_.begin(), sorted_.end(), distances_a_[v] - within_);
    return static_cast<std::size_t>(std::upper_bound(low, sorted_.end(), distances_a_[v] + within_) - low);
  }

  /// Two vertices far from the center, in different directions, with few others as far as each.
  std::optional<Edge> choose_landmarks() const {
    const double least = kFar * sorted_.back();
    std::optional<std::uint32_t> first, second;
    std::size_t best = 0;
    for (std::uint32_t v = 0; v < distances_a_.size(); ++v) {
      if (distances_a_[v] < least) continue;
      const std::size_t count = alike(v);
      if (first && count >= best) continue;
      first = v;
      best = count;
    }
    if (!first) return std::nullopt;
    const Vec3 axis = (a_.vertices[*first] - center_a_) / distances_a_[*first];
    // Slender shapes have no second vertex that is far in another direction: it is the one farthest off the axis then.
    double widest = 0;
    for (const Vec3& p : a_.vertices) widest = std::max(widest, length(cross(axis, p - center_a_)));
    for (std::uint32_t v = 0; v < distances_a_.size(); ++v) {
      const double off = length(cross(axis, a_.vertices[v] - center_a_));
      if (off < std::min(widest, std::max(kFar * widest, kMinSine * least))) continue;
      const std::size_t count = alike(v);
      if (second && count >= best) continue;
      second = v;
      best = count;
    }
    return second ? std::optional<Edge>({*first, *second}) : std::nullopt;
  }

  /// The vertices of `b` that the motion takes those of `a` to.
  std::optional<std::vector<std::uint32_t>> matched(const RigidTransform& motion, double within) const {
    std::vector<std::uint32_t> match;
    std::vector<bool> used(b_.vertices.size());
    match.reserve(a_.vertices.size());
    for (const Vec3& p : a_.vertices) {
      const std::optional<std::uint32_t> v = grid_.nearest(motion * p, within, used);
      if (!v) return std::nullopt;
      used[*v] = true;
      match.push_back(*v);
    }
    return match;
  }

  /// The motion corrected so that the squares of the distances between matching vertices are least, to first order.
  RigidTransform corrected(const RigidTransform& motion, const std::vector<std::uint32_t>& match) const {
    Mat3 inertia{{{}, {}, {}}};
    Vec3 moment;
    for (std::size_t v = 0; v < match.size(); ++v) {
      const Vec3 p = motion.rotation * (a_.vertices[v] - center_a_), off = b_.vertices[match[v]] - center_b_ - p;
      moment += cross(p, off);
      for (int i = 0; i < 3; ++i) {
        inertia.row[i] += -p[i] * p;
        inertia.row[i][i] += length_squared(p);
      }
    }
    const Mat3 turn = rotation_by(solved(inertia, moment)) * motion.rotation;
    return {turn, center_b_ - turn * center_a_};
  }

  std::optional<RigidTransform> verified(const RigidTransform& rough) const {
    const auto first = matched(rough, kLoose * within_);
    if (!first) return std::nullopt;
    const RigidTransform motion = corrected(rough, *first);
    const auto match = matched(motion, within_);
    if (!match) return std::nullopt;
    std::vector<Face> faces;
    faces.reserve(a_.faces.size());
    for (const Face& f : a_.faces) faces.push_back({{(*match)[f.v[0]], (*match)[f.v[1]], (*match)[f.v[2]]}});
    if (!same_surface(b_.vertices, std::move(faces), b_.faces, within_)) return std::nullopt;
    return motion;
  }

  const TriangleMesh& a_;
  const TriangleMesh& b_;
  Vec3 center_a_, center_b_;
  double within_;  // between matching vertices [mm]
  VertexGrid grid_;
  const std::vector<double>& sorted_;
  std::vector<double> distances_a_, distances_b_;
};

}  // namespace

std::optional<RigidTransform> congruence(const TriangleMesh& a, const MeshInvariants& of_a, const TriangleMesh& b,
                                         const MeshInvariants& of_b) {
  if (a == b) return RigidTransform{};
  if (!may_be_congruent(of_a, of_b) || !(of_a.distances.back() > 0)) return std::nullopt;
  return CongruenceSearch(a, of_a, b, of_b).run();
}

std::optional<RigidTransform> congruence(const TriangleMesh& a, const TriangleMesh& b) {
  return congruence(a, mesh_invariants(a), b, mesh_invariants(b));
}

}  // namespace dismantle
