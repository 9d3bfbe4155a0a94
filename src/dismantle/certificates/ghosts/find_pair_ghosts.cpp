// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/find_pair_ghosts.h"

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/ghosts/separating_ghost.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/narrowphase/closest_points.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/depth/moving_part_search.h"
#include "dismantle/surface/depth/nowhere_deeper.h"
#include "dismantle/surface/ghost_surface.h"
#include "dismantle/surface/winding_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

/// The largest displacements that are tried, the shorter ones first. The long ones are for corners between faces that
/// are retracted; the faces themselves are not retracted further.
constexpr double kFactors[] = {1, 1.1, 1.25, 1.6, kMaxGhostFactor};
/// Lengths that differ by this share are equal.
constexpr double kRounding = 1e-9;
/// Up to this one, corners are displaced one by one as well, and sheets, in which nothing is deep.
constexpr double kMaxFactorForCorners = 1.25;
/// Faces are retracted by these multiples of what the samples need, as far as the depth of the pair lets them: more may
/// be needed between the samples, and less may be had where one patch lies on two others.
constexpr double kMargins[] = {1.6, 1};
/// Ghosts are made to be apart by these shares of the tolerance, the larger ones if they can be.
constexpr double kGaps[] = {0.62, 0.3, 0.1};
/// Depths and retractions below this share of the tolerance are within the play of the ghosts that components have.
constexpr double kPlay = 0.3;
/// Shallower pairs do not overlap, as a share of the tolerance; the second one where one of the two is a sheet.
constexpr double kOverlap = 0.1, kSheetOverlap = 1e-3;
/// Ghosts are not made by displacing corners pair by pair where more pairs of faces are near each other.
constexpr std::size_t kMaxNear = 200000;
/// Where still more are, as in parts that are modelled in the place of each other, the search for ghosts ends.
constexpr std::size_t kTooManyNear = 1000000;
/// A shift of a whole surface is to be free from this share of its way on; the second one for surfaces that overlap.
constexpr double kShiftBegins[] = {0.02, 0.9};
/// So many directions are tried for that, of those that lead to the right side by at least this cosine.
constexpr std::size_t kMaxDirections = 12;
constexpr double kSameSide = 0.05;
/// Patches are left out of the retraction one by one only where no more than this number overlap.
constexpr std::size_t kMaxPatches = 24;
/// Largest number of tests of pairs of faces in that search.
constexpr std::size_t kMaxTests = 2000000;
/// Largest number of pieces examined to bound the depth of displaced faces.
constexpr std::size_t kMaxPieces = 100000;
/// So many vertices of each surface are looked at.
constexpr std::size_t kContainmentSamples = 8;

/// The depth from which a pair counts as overlapping [mm]. Solids that are shallower have room within their usual
/// ghosts; the ghost of a sheet is the sheet itself, so a sheet that is inside at all needs one of its own.
double overlap_from(const PairGhostRequest& request) {
  const bool solids = request.a.tree->has_outside && request.b.tree->has_outside;
  return (solids ? kOverlap : kSheetOverlap) * request.tolerance;
}

using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// One component's ghost against the other component, both in the assembled state.
class GhostSide {
 public:
  GhostSide(const PairGhostRequest& request, bool of_a)
      : own_(of_a ? request.a : request.b),
        other_(of_a ? request.b : request.a),
        usual_(of_a ? request.ghost_a : request.ghost_b),
        request_(request),
        is_a_(of_a) {}

  bool usual_is_apart() const { return apart(*usual_, near_faces(*usual_, 0)); }

  /// Displaced vertices.
  struct Found {
    std::vector<Vec3> vertices;
    bool retracted = false;  ///< Every face into its solid.
  };
  /// Displaced vertices with displacements of at most `max_length`; nothing if none are found.
  /// @param depth_limit no point gets deeper in its solid on its way to the displaced surface [mm]
  std::optional<Found> find(double max_length, double depth_limit, bool also_corners) {
    depth_limit_ = depth_limit;
    const double tolerance = request_.tolerance, usual = kGaps[0] * tolerance;
    const SolidTree& own = *own_.tree;
    const std::vector<Face> outward = outward_faces(own.faces, own.inside_out);
    std::vector<std::vector<Vec3>> starts;
    if (own.has_outside || own.inside_out || request_.depth > tolerance)
      for (const double margin : kMargins)
        starts.push_back(retracted_vertices(own.vertices, outward, {needed(margin), usual, usual, max_length}));
    const std::size_t retractions = own.has_outside || own.inside_out ? starts.size() : 0;
    if (overlaps()) starts.push_back(moved_out(usual, max_length));
    const FacePairs& near = near_within(max_length + usual);
    if (near.size() > kTooManyNear) {
      has_ended_ = true;
      return std::nullopt;
    }
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (apart(displaced(starts[i]), near) && shallow(starts[i], max_length))
        return Found{std::move(starts[i]), i < retractions};
    if (near.size() > kMaxNear) return std::nullopt;
    if (retractions > 0 && overlaps()) {
      // At sharp corners with faces that overlap nothing, those follow.
      std::vector<double> others_follow = needed(1);
      for (double& n : others_follow)
        if (n == 0) n = kFollowsOthers;
      auto moved = retracted_vertices(own.vertices, outward, {others_follow, usual, usual, max_length});
      if (apart(displaced(moved), near) && shallow(moved, max_length)) return Found{std::move(moved), false};
    }
    if (retractions > 0)
      if (auto chosen = retract_chosen(near, max_length)) return chosen;
    if (!also_corners) return std::nullopt;
    starts.push_back(own.vertices);
    for (const std::vector<Vec3>& start : starts)
      for (const double share : kGaps) {
        auto moved = separating_ghost({&own, other_.tree, start, near, max_length, share * tolerance, is_a_});
        if (!moved || !apart(displaced(*moved), near) || !shallow(*moved, max_length)) continue;
        auto shifted = &start == &starts.back() ? find_shifted(near, *moved, max_length) : std::nullopt;
        return Found{shifted ? std::move(*shifted) : std::move(*moved), false};
      }
    auto shifted = find_shifted(near, {}, max_length);
    return shifted ? std::optional(Found{std::move(*shifted), false}) : std::nullopt;
  }

  /// A find() has found so many faces near each other that no other one is of use.
  bool has_ended() const { return has_ended_; }

 private:
  /// The whole surface shifted away from the other one, if nothing is in the way: thin parts and sheets can then slide
  /// along what they touch, and their other side stays clear of it.
  /// @param off vertices that are displaced to the right side; none: either side, where it is free
  std::optional<std::vector<Vec3>> find_shifted(const FacePairs& near, Span<const Vec3> off, double max_length) const {
    const std::vector<Vec3>& vertices = own_.tree->vertices;
    const auto way_with = [&](double share) {
      return std::min(max_length, request_.depth + share * request_.tolerance);
    };
    const std::vector<Vec3> directions = directions_off(near, off);
    // A part that pierces a foil must be shifted further than the depth of the overlap.
    for (const double way : {way_with(kGaps[0]), way_with(kGhostLength)})
      for (const double begin : kShiftBegins)
        for (const Vec3& direction : directions) {
          const Vec3 shift = way * direction;
          if (!free(*own_.tree, near, begin * shift, shift)) continue;
          std::vector<Vec3> shifted = vertices;
          for (Vec3& p : shifted) p += shift;
          if (!contained(displaced(shifted))) return shifted;
        }
    return std::nullopt;
  }

  /// Directions in which this surface may come off the other one: normals of faces that touch or intersect, and the
  /// mean of displacements to the right side.
  std::vector<Vec3> directions_off(const FacePairs& near, Span<const Vec3> off) const {
    Vec3 sum;
    for (std::size_t i = 0; i < off.size(); ++i) sum += off[i] - own_.tree->vertices[i];
    if (length(sum) == 0 && !off.empty()) return {};
    std::vector<Vec3> directions;
    const auto add_one = [&](Vec3 d) {
      const auto same = [&](Vec3 known) { return dot(known, d) > 1 - 1e-6; };
      if (directions.size() < kMaxDirections && std::none_of(directions.begin(), directions.end(), same))
        directions.push_back(d);
    };
    const auto add = [&](Vec3 d) {
      const double along = dot(d, sum), enough = kSameSide * length(sum);
      if (along >= enough) add_one(d);
      if (along <= -enough) add_one(-d);
    };
    for (const auto& [face_own, face_other] : near) {
      const Triangle own = own_.tree->triangle(face_own), other = other_.tree->triangle(face_other);
      if (distance_triangle_triangle(own, other).distance > kShiftBegins[0] * request_.tolerance) continue;
      add(normalized(normal_unscaled(own)));
      add(normalized(normal_unscaled(other)));
    }
    if (length(sum) > 0) add(normalized(sum));
    return directions;
  }

  /// Vertices where fewer patches are retracted than overlap: along the edge between two patches, points that are
  /// nearest to one of them get out through the other one as well. One patch after another is left where it is, or,
  /// where that is better, follows its neighbours, as long as fewer faces meet.
  std::optional<Found> retract_chosen(const FacePairs& near, double max_length) {
    const SolidTree& own = *own_.tree;
    const std::vector<std::uint32_t> patches = overlapping_patches();
    if (patches.size() < 2 || patches.size() > kMaxPatches) return std::nullopt;
    const std::vector<Face> outward = outward_faces(own.faces, own.inside_out);
    const double usual = kGaps[0] * request_.tolerance;
    std::vector<double> chosen = needed(kMargins[0]);
    const auto vertices_with = [&](std::uint32_t patch, double retraction) {
      std::vector<double> changed = chosen;
      set_patch(changed, patch, retraction);
      return retracted_vertices(own.vertices, outward, {changed, usual, usual, max_length});
    };
    constexpr double kOthers[] = {0, kFollowsOthers};
    std::size_t fewest = count_meeting(displaced(vertices_with(patches[0], chosen[patches[0]])), near, near.size());
    bool retracted = true;
    for (std::size_t round = 0; round < patches.size(); ++round) {
      std::optional<std::pair<std::uint32_t, double>> best;
      for (const std::uint32_t patch : patches)
        for (const double other : kOthers) {
          if (fewest == 0 || chosen[patch] <= other) continue;
          if ((tests_ += near.size()) > kMaxTests) return std::nullopt;
          const std::size_t meeting = count_meeting(displaced(vertices_with(patch, other)), near, fewest);
          if (meeting >= fewest) continue;
          fewest = meeting;
          best = {patch, other};
        }
      if (!best) return std::nullopt;
      retracted = retracted && best->second == 0;
      set_patch(chosen, best->first, best->second);
      if (fewest > 0) continue;
      std::vector<Vec3> found = retracted_vertices(own.vertices, outward, {chosen, usual, usual, max_length});
      if (contained(displaced(found)) || !shallow(found, max_length)) return std::nullopt;
      return Found{std::move(found), retracted};
    }
    return std::nullopt;
  }

  /// Found when it is first wanted: most pairs need none.
  const OverlapRetraction& retraction() const {
    if (!retraction_) retraction_ = overlap_retraction(own_, other_, request_.depth, request_.tolerance);
    return *retraction_;
  }

  /// The patches that are to be retracted, each as one of its faces.
  std::vector<std::uint32_t> overlapping_patches() const {
    std::vector<std::uint32_t> patches;
    for (std::uint32_t f = 0; f < own_.tree->faces.size(); ++f)
      if (retraction().patch[f] == f && retraction().needed[f] > 0) patches.push_back(f);
    return patches;
  }

  void set_patch(std::vector<double>& retractions, std::uint32_t patch, double by) const {
    for (std::uint32_t f = 0; f < retractions.size(); ++f)
      if (retraction().patch[f] == patch) retractions[f] = by;
  }

  /// Number of pairs of faces that meet, or `enough`.
  std::size_t count_meeting(const SolidTree& surface, const FacePairs& near, std::size_t enough) const {
    const TrianglePairSweep sweep(surface, *other_.tree, {}, {}, 0, request_.tolerance);
    std::size_t meeting = 0;
    for (const auto& [face_own, face_other] : near)
      if (!sweep.test(face_own, face_other, {}).free && ++meeting >= enough) break;
    return meeting;
  }

  /// True if no face, moving in a straight line to its displaced position, passes a point that is deeper in this
  /// component than the pair may be. Every such point is then still inside the displaced surface, however long the
  /// displacements are.
  /// @param max_length of the displacements [mm]
  bool shallow(const std::vector<Vec3>& vertices, double max_length) const {
    const SolidTree& own = *own_.tree;
    const bool is_sheet = !own.has_outside && !own.inside_out;
    if (max_length <= depth_limit_ * (is_sheet ? kMaxFactorForCorners : 1) * (1 + kRounding)) return true;
    if (is_sheet) return false;
    std::size_t pieces = 0;
    for (const Face& f : own.faces) {
      double longest = 0;
      for (const std::uint32_t v : f.v) longest = std::max(longest, length(vertices[v] - own.vertices[v]));
      if (longest <= depth_limit_) continue;
      const Triangle from{{own.vertices[f.v[0]], own.vertices[f.v[1]], own.vertices[f.v[2]]}};
      const Triangle to{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}};
      if (!stays_shallow(own_.shape(), from, to, depth_limit_, pieces, kMaxPieces)) return false;
    }
    return true;
  }

  /// How far the faces are retracted [mm]: no further than the depth, or their corners would get too deep.
  std::vector<double> needed(double margin) const {
    std::vector<double> needed = retraction().needed;
    const double most = std::max(request_.depth, retraction().turning);
    for (double& n : needed) n = std::max(std::min(margin * n, most), request_.everywhere);
    return needed;
  }

  bool overlaps() const { return request_.depth > overlap_from(request_); }

  /// The vertices, those inside the other component moved out of it the shortest way.
  std::vector<Vec3> moved_out(double gap, double max_length) const {
    std::vector<Vec3> moved = own_.tree->vertices;
    const SurfaceTree& surface = other_.shape().surface();
    for (Vec3& p : moved) {
      const MeshDistance nearest = surface.distance(p);
      if (nearest.distance > max_length || nearest.distance == 0 || !other_.shape().winding().inside(p)) continue;
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
      double winding = 0;
      for (std::uint32_t f = 0; f < surface.faces.size(); ++f) winding += winding_of(surface.triangle(f), p);
      return std::abs(winding) > 0.5;
    };
    return some(surface.vertices, [&](Vec3 p) { return other_.shape().winding().inside(p); }) ||
           some(other_.tree->vertices, inside_surface);
  }

  /// This component's surface with other positions of its vertices, without a tree.
  SolidTree displaced(std::vector<Vec3> vertices) const {
    SolidTree surface;
    surface.vertices = std::move(vertices);
    surface.faces = own_.tree->faces;
    return surface;
  }

  /// True if a surface and the other component do not meet.
  /// @param near all pairs of their faces that may
  bool apart(const SolidTree& surface, const FacePairs& near) const {
    return free(surface, near, {}, {}) && !contained(surface);
  }

  /// True if a surface does not meet the other component while it is shifted.
  /// @param near all pairs of their faces that may
  bool free(const SolidTree& surface, const FacePairs& near, Vec3 from, Vec3 to) const {
    const TrianglePairSweep sweep(surface, *other_.tree, {from, {}}, {to, {}}, 0, request_.tolerance);
    const auto meet = [&](const auto& faces) { return !sweep.test(faces.first, faces.second, {}).free; };
    return std::none_of(near.begin(), near.end(), meet);
  }

  /// The pairs of faces of the two components that are nearer than `reach` [mm], and some more.
  const FacePairs& near_within(double reach) {
    if (reach <= near_reach_) return near_;
    // Where the shortest displacements were not enough, somewhat longer ones will be tried as well.
    near_reach_ = near_reach_ > 0 ? std::max(reach, kMaxFactorForCorners * near_reach_) : reach;
    near_ = near_faces(*own_.tree, near_reach_);
    return near_;
  }

  /// The pairs of faces of a surface and of the other component that are nearer than `reach` [mm], and some more.
  FacePairs near_faces(const SolidTree& surface, double reach) const {
    const TrianglePairSweep still(surface, *other_.tree, {}, {}, 0, request_.tolerance);
    PairMotion motion = still.motion();
    motion.allowed = -reach;
    const CertificateFront pairs{
        surface.tree, other_.tree->tree, surface.revolution.get(), other_.tree->revolution.get(), {}};
    FacePairs faces;
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
  mutable std::optional<OverlapRetraction> retraction_;
  FacePairs near_;
  double near_reach_ = 0;  // of `near_` [mm]
  std::size_t tests_ = 0;  // of retract_chosen()
  double depth_limit_ = 0;
  bool has_ended_ = false;
};

}  // namespace

std::optional<PairGhosts> find_pair_ghosts(const PairGhostRequest& request) {
  GhostSide a(request, true), b(request, false);
  const double turning = turning_retraction(request.a, request.b, request.depth, request.tolerance);
  const bool can_turn = turning <= kPlay * request.tolerance;
  const bool usual = request.depth <= request.tolerance && can_turn && a.usual_is_apart() && b.usual_is_apart();
  const double play = std::min(kPlay / kOverlap * overlap_from(request), kPlay * request.tolerance);
  if (usual && request.depth <= play) return PairGhosts{};
  const double limit = std::max(request.depth, turning) + kGhostLength * request.tolerance;
  std::optional<GhostSide::Found> of_a, of_b;
  for (const double factor : kFactors) {
    const double length = factor * limit;
    // Through a thin part, points would get by their displacement.
    if (factor > 1 && (is_nowhere_deeper(request.a.shape(), length) || is_nowhere_deeper(request.b.shape(), length)))
      break;
    const bool also_corners = factor <= kMaxFactorForCorners;
    if (!of_a) of_a = a.find(length, limit, also_corners);
    if (of_a && !of_b) of_b = b.find(length, limit, also_corners);
    if (a.has_ended() || b.has_ended()) break;
    if (of_a && of_b)
      return PairGhosts{{std::move(of_a->vertices), std::move(of_b->vertices)},
                        length,
                        can_turn ? 0 : turning,
                        of_a->retracted && of_b->retracted};
  }
  return usual ? std::optional(PairGhosts{}) : std::nullopt;
}

}  // namespace dismantle
