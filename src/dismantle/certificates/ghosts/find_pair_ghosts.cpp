// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/find_pair_ghosts.h"

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/ghosts/separating_ghost.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/math/angle.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/surface/ghost_surface.h"

#include "dismantle/narrowphase/intersect_triangle_triangle.h"
#include <cstdio>
#include <cstdlib>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// Displacements as multiples of the depth plus the tolerance: the shorter ones are tried first.
constexpr double kFactors[] = {1, 1.1, kMaxGhostFactor};
/// Ghosts are made to be apart by these shares of the tolerance, the larger ones if they can be.
constexpr double kGaps[] = {0.62, 0.3, 0.1};
/// Retractions below this share of the tolerance are within the play of the ghosts that components have.
constexpr double kPlay = 0.3;
/// Shallower pairs do not overlap, as a share of the tolerance.
constexpr double kOverlap = 0.1;
/// So many vertices of each surface are looked at.
constexpr std::size_t kContainmentSamples = 8;

/// The solid angle of a triangle seen from a point, signed (Van Oosterom, Strackee 1983).
double solid_angle(const Triangle& t, Vec3 p) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double x = length(a), y = length(b), z = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
}

/// One component's ghost against the other component, both in the assembled state.
class GhostSide {
 public:
  GhostSide(const PairGhostRequest& request, bool of_a)
      : own_(of_a ? request.a : request.b),
        other_(of_a ? request.b : request.a),
        usual_(of_a ? request.ghost_a : request.ghost_b),
        request_(request),
        is_a_(of_a),
        retraction_(overlap_retraction(own_, other_, request.depth, request.tolerance)) {}

  const OverlapRetraction& retraction() const { return retraction_; }
  bool usual_is_apart() const { return apart(*usual_); }

  /// Displaced vertices with displacements of at most `max_length`; nothing if none are found.
  std::optional<std::vector<Vec3>> find(double max_length) const {
    const double tolerance = request_.tolerance, usual = kGaps[0] * tolerance;
    const SolidTree& own = *own_.tree;
    std::vector<std::vector<Vec3>> starts;
    if (own.has_outside || own.inside_out || request_.depth > tolerance)
      starts.push_back(retracted_vertices(own.vertices, outward_faces(own.faces, own.inside_out),
                                          {retraction_.needed, usual, usual, max_length}));
    if (overlaps()) starts.push_back(moved_out(usual, max_length));
    for (std::vector<Vec3>& start : starts)
      if (apart(make_displaced_tree(own, start, {}))) return std::move(start);
    if (std::getenv("GDBG2")) {
      double most = 0; int n = 0;
      for (double x : retraction_.needed) most = std::max(most, x), n += x > 0;
      std::fprintf(stderr, "  side %d: depth %.5g max_length %.5g turning %.5g needed %.5g (%d of %zu faces)\n", is_a_, request_.depth, max_length, retraction_.turning, most, n, retraction_.needed.size());
      for (auto& start : starts) { dbg(make_displaced_tree(own, start, {}), start); }
    }
    if (starts.empty()) starts.push_back(own.vertices);
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> near = near_faces(2 * max_length);
    for (const std::vector<Vec3>& start : starts)
      for (const double share : kGaps) {
        auto moved = separating_ghost({own_.tree, other_.tree, start, near, max_length, share * tolerance, is_a_});
        if (moved && apart(make_displaced_tree(own, *moved, {}))) return moved;
      }
    return std::nullopt;
  }

 private:
  /// A front of a surface of this component and the other component.
  CertificateFront front(const SolidTree& surface) const {
    return {surface.tree, other_.tree->tree, surface.revolution.get(), other_.tree->revolution.get(), {}};
  }

  void dbg(const SolidTree& surface, const std::vector<Vec3>& start) const {
    double len = 0;
    for (std::size_t i = 0; i < start.size(); ++i) len = std::max(len, length(start[i] - own_.tree->vertices[i]));
    int n = 0, shown = 0;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
      for (std::uint32_t g = 0; g < other_.tree->faces.size() && surface.faces.size() * other_.tree->faces.size() < 100000000; ++g) {
        const Triangle s = surface.triangle(f), t = other_.tree->triangle(g);
        if (!intersect_triangle_triangle(s, t)) continue;
        ++n;
        if (shown++ < 4) { const Vec3 a = normalized(normal_unscaled(own_.tree->triangle(f))), b = normalized(normal_unscaled(t)); const Vec3 c = (t[0]+t[1]+t[2])/3, d=(s[0]+s[1]+s[2])/3;
          std::fprintf(stderr, "    face %u n (%.2f %.2f %.2f) at (%.3f %.3f %.3f) needed %.4g displ %.4g %.4g %.4g; other %u n (%.2f %.2f %.2f) at (%.3f %.3f %.3f)\n", f, a.x,a.y,a.z, d.x,d.y,d.z, retraction_.needed[f], length(start[own_.tree->faces[f].v[0]] - own_.tree->vertices[own_.tree->faces[f].v[0]]), length(start[own_.tree->faces[f].v[1]] - own_.tree->vertices[own_.tree->faces[f].v[1]]), length(start[own_.tree->faces[f].v[2]] - own_.tree->vertices[own_.tree->faces[f].v[2]]), g, b.x,b.y,b.z, c.x,c.y,c.z); }
      }
    std::fprintf(stderr, "   start: longest %.5g, %d crossing pairs\n", len, n);
  }
  bool overlaps() const { return request_.depth > kOverlap * request_.tolerance; }

  /// The vertices, those inside the other component moved out of it the shortest way.
  std::vector<Vec3> moved_out(double gap, double max_length) const {
    std::vector<Vec3> moved = own_.tree->vertices;
    const SurfaceTree& surface = other_.shape->surface();
    for (Vec3& p : moved) {
      const MeshDistance nearest = surface.distance(p);
      if (nearest.distance > max_length || nearest.distance == 0 || !other_.shape->winding().inside(p)) continue;
      const Vec3 out = (closest_point_of_triangle(surface.triangle(nearest.face), p) - p) / nearest.distance;
      p += std::min(max_length, nearest.distance + gap) * out;
    }
    return moved;
  }

  /// True if some of a few vertices of two surfaces that do not meet is inside the other one.
  bool contained(const SolidTree& surface) const {
    if (!overlaps()) return false;
    const auto some = [](const std::vector<Vec3>& points, const auto& inside) {
      const std::size_t stride = std::max<std::size_t>(1, points.size() / kContainmentSamples);
      for (std::size_t i = 0; i < points.size(); i += stride)
        if (inside(points[i])) return true;
      return false;
    };
    const auto inside_surface = [&](Vec3 p) {
      double angle = 0;
      for (std::uint32_t f = 0; f < surface.faces.size(); ++f) angle += solid_angle(surface.triangle(f), p);
      return std::abs(angle) > kTurn;
    };
    return some(surface.vertices, [&](Vec3 p) { return other_.shape->winding().inside(p); }) ||
           some(other_.tree->vertices, inside_surface);
  }

  bool apart(const SolidTree& surface) const {
    const TrianglePairSweep still(surface, *other_.tree, {}, {}, 0, {0, request_.tolerance, {}});
    PairMotion motion = still.motion();
    motion.max_blocked = 1;
    const CertificateFront pairs = front(surface);
    bool free = true;
    const TrianglePairTest test = [&](const TrianglePairCandidate& candidate) {
      const Vec3f hint = candidate.hint;
      const TrianglePairResult found =
          still.test(candidate.face_moving, candidate.face_fixed, {hint.x, hint.y, hint.z});
      free &= found.free;
      return TrianglePairVerdict{found.free, 0, false, {}};
    };
    return pairs.sweep_const(pairs.prepare_sweep(motion), request_.kernels, test).complete && free &&
           !contained(surface);
  }

  std::vector<std::pair<std::uint32_t, std::uint32_t>> near_faces(double reach) const {
    const TrianglePairSweep still(*own_.tree, *other_.tree, {}, {}, 0, {0, request_.tolerance, {}});
    PairMotion motion = still.motion();
    motion.allowed = -reach;
    const CertificateFront pairs = front(*own_.tree);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> faces;
    const TrianglePairTest take = [&](const TrianglePairCandidate& candidate) {
      faces.emplace_back(candidate.face_moving, candidate.face_fixed);
      return TrianglePairVerdict{};
    };
    pairs.sweep_const(pairs.prepare_sweep(motion), request_.kernels, take);
    return faces;
  }

  const OverlapSide& own_;
  const OverlapSide& other_;
  const SolidTree* usual_;
  const PairGhostRequest& request_;
  bool is_a_;
  OverlapRetraction retraction_;
};

}  // namespace

std::optional<PairGhosts> find_pair_ghosts(const PairGhostRequest& request) {
  const GhostSide a(request, true), b(request, false);
  const double turning = std::max(a.retraction().turning, b.retraction().turning);
  const bool turns = turning <= kPlay * request.tolerance;
  if (request.depth <= request.tolerance && turns && a.usual_is_apart() && b.usual_is_apart()) return PairGhosts{};
  for (const double factor : kFactors) {
    const double length = factor * (std::max(request.depth, turning) + kGhostLength * request.tolerance);
    auto of_a = a.find(length);
    if (!of_a) continue;
    auto of_b = b.find(length);
    if (of_b) return PairGhosts{{std::move(*of_a), std::move(*of_b)}, length};
  }
  return std::nullopt;
}

}  // namespace dismantle
