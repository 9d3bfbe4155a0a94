// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/find_pair_ghosts.h"

#include "dismantle/certificates/ghosts/coaxial_ghost.h"
#include "dismantle/certificates/ghosts/displaced_faces.h"
#include "dismantle/certificates/ghosts/near_face_pairs.h"
#include "dismantle/certificates/ghosts/separating_ghost.h"
#include "dismantle/certificates/ghosts/shifted_ghost.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/surface/depth/moving_part_search.h"
#include "dismantle/surface/depth/nowhere_deeper.h"
#include "dismantle/surface/ghost_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
/// Faces that are no further apart than this share of the tolerance touch.
constexpr double kTouching = 0.02;
/// Patches are left out of the retraction one by one only where no more than this number overlap.
constexpr std::size_t kMaxPatches = 24;
/// Largest number of tests of pairs of faces in that search.
constexpr std::size_t kMaxTests = 200000;
/// Gaps of ghosts about a common axis, as shares of the depth: as much room as there is, as the axis is not exact.
constexpr double kCoaxialGaps[] = {0.05, 0.02, 0.01, 0.005, 0.002};
/// Two axes are one if they are no further apart than this share of the depth.
constexpr double kSameAxis = 0.05;
/// Largest number of pieces examined to bound the depth of displaced faces.
constexpr std::size_t kMaxPieces = 100000;

/// The depth from which a pair counts as overlapping [mm]. Solids that are shallower have room within their usual
/// ghosts; the ghost of a sheet is the sheet itself, so a sheet that is inside at all needs one of its own.
double overlap_from(const PairGhostRequest& request) {
  const bool solids = request.a.tree->has_outside && request.b.tree->has_outside;
  return (solids ? kOverlap : kSheetOverlap) * request.tolerance;
}

/// True if points could get to the far side of one of the solids by displacements of this length [mm].
bool passes_thin_part(const PairGhostRequest& request, double length) {
  return is_nowhere_deeper(request.a.shape(), length) || is_nowhere_deeper(request.b.shape(), length);
}

/// One component's ghost against the other component, both in the assembled state.
class GhostSide {
 public:
  GhostSide(const PairGhostRequest& request, PairOverlap& overlap, bool of_a)
      : own_(of_a ? request.a : request.b),
        other_(of_a ? request.b : request.a),
        usual_(of_a ? request.ghost_a : request.ghost_b),
        displaced_(own_, other_, request.tolerance),
        request_(request),
        overlap_(overlap),
        is_a_(of_a) {}

  bool usual_is_apart() const {
    const TrianglePairSweep still(*usual_, *other_.tree, {}, {}, 0, request_.tolerance);
    for (const auto& [own, other] : near_faces(*usual_, 0))
      if (!still.test(own, other, {}).free) return false;
    return !overlaps() || !displaced_.contained(usual_->vertices);
  }

  /// Displaced vertices.
  struct Found {
    std::vector<Vec3> vertices;
    bool retracted = false;  ///< Every face into its solid.
  };
  /// Displaced vertices with displacements of at most `max_length`; nothing if none are found.
  /// @param depth_limit no point gets deeper in its solid on its way to the displaced surface [mm]
  std::optional<Found> find(double max_length, double depth_limit, bool also_corners) {
    depth_limit_ = depth_limit;
    max_length_ = max_length;
    std::optional<Found> found = find_displaced(also_corners);
    // Sheets slide on what they touch or pierce in one place only if all of them is off it.
    if (found && own_.is_sheet())
      if (auto shifted = find_shifted(found->vertices)) found->vertices = std::move(*shifted);
    return found;
  }

 private:
  /// As find(), with the length and the limit that it was given.
  std::optional<Found> find_displaced(bool also_corners) {
    const bool solid = !own_.is_sheet();
    std::vector<std::vector<Vec3>> starts;
    const auto good = [&](std::vector<Vec3> vertices, bool into_solid) -> std::optional<Found> {
      if (apart(vertices) && shallow(vertices)) return Found{std::move(vertices), into_solid};
      starts.push_back(std::move(vertices));
      return std::nullopt;
    };
    if (solid || request_.depth > request_.tolerance)
      for (const double margin : kMargins)
        if (auto found = good(retracted(needed(margin)), solid)) return found;
    if (overlaps())
      if (auto found =
              good(displaced_.moved_out(own_.tree->vertices, kGaps[0] * request_.tolerance, max_length_), false))
        return found;
    const std::size_t start_count = starts.size();
    if (solid && overlaps()) {
      if (auto found = find_coaxial()) return found;
      // At sharp corners with faces that overlap nothing, those follow.
      std::vector<double> others_follow = needed(1);
      for (double& n : others_follow)
        if (n == 0) n = kFollowsOthers;
      if (auto found = good(retracted(others_follow), false)) return found;
    }
    if (solid)
      if (auto chosen = retract_chosen()) return chosen;
    starts.resize(start_count);
    return also_corners ? displace_corners(std::move(starts)) : std::nullopt;
  }

  /// Moves what engages about a shared axis out of the way: where possible only in a range where the overlap is much
  /// deeper than elsewhere, so that the rest still holds the two together.
  std::optional<Found> find_coaxial() {
    if (std::exchange(tried_coaxial_, true)) return std::nullopt;
    const auto axes = common_axes(*own_.tree, *other_.tree, kSameAxis * depth_limit_);
    if (axes.empty()) return std::nullopt;
    const double length = std::exchange(max_length_, longest());
    std::optional<std::vector<Vec3>> found;
    for (const RevolutionAxis& axis : axes)
      if (!found)
        for (const DeepRange& range : deep_ranges(own_, other_, axis, kPlay * request_.tolerance, request_.depth))
          if (!found) found = find_in(range, axis);
    for (const RevolutionAxis& axis : axes)
      for (const bool whole : {true, false})
        if (!found) found = coaxial(axis, retracted({}), whole, {});
    max_length_ = length;
    return found ? std::optional(Found{std::move(*found), true}) : std::nullopt;
  }

  /// Moves what engages out of the way within a range of the axis only; retracts the faces outside it by their needs.
  std::optional<std::vector<Vec3>> find_in(const DeepRange& range, const RevolutionAxis& axis) {
    std::vector<double> elsewhere = needed(kMargins[0]);
    for (double& n : elsewhere) n = std::max(std::min(n, range.elsewhere), request_.everywhere);
    const std::vector<Vec3> retracted = this->retracted(elsewhere);
    const AxisFrame frame(axis.point, axis.direction);
    std::vector<bool> deep(retracted.size());
    std::vector<Vec3> start = retracted;
    for (std::size_t v = 0; v < deep.size(); ++v) {
      // Vertices at one position move alike, also where rounding puts them on two sides of the border.
      deep[v] = range.contains(frame.along(own_.tree->vertices[surface().first()[v]]), max_length_);
      if (deep[v]) start[v] = usual_->vertices[v];
    }
    if (auto found = coaxial(axis, start, true, deep)) return found;
    return coaxial(axis, retracted, true, deep);
  }

  std::optional<std::vector<Vec3>> coaxial(const RevolutionAxis& axis, const std::vector<Vec3>& start, bool whole,
                                           const std::vector<bool>& movable) {
    std::vector<double> gaps;
    for (const double share : kCoaxialGaps) gaps.push_back(share * request_.depth);
    gaps.push_back(kGaps[0] * request_.tolerance);
    return coaxial_ghost({&own_, &other_, &surface(), axis, start, max_length_, depth_limit_, gaps, whole, movable},
                         [&](const std::vector<Vec3>& vertices) { return apart(vertices) && shallow(vertices); });
  }

  /// The largest displacement by which points of thin parts do not get past each other [mm].
  double longest() const {
    double longest = depth_limit_;
    for (const double factor : kFactors) {
      if (factor > 1 && passes_thin_part(request_, factor * depth_limit_)) break;
      longest = factor * depth_limit_;
    }
    return longest;
  }

  /// Corners displaced one by one until their faces are apart, from several starts, or the whole surface shifted.
  std::optional<Found> displace_corners(std::vector<std::vector<Vec3>> starts) {
    const FacePairs* near = few_near();
    if (!near) return std::nullopt;
    starts.push_back(own_.tree->vertices);
    for (const std::vector<Vec3>& start : starts)
      for (const double share : kGaps) {
        auto moved =
            separating_ghost({own_.tree, other_.tree, start, *near, max_length_, share * request_.tolerance, is_a_});
        if (!moved || !apart(*moved) || !shallow(*moved)) continue;
        auto shifted = &start == &starts.back() && !own_.is_sheet() ? find_shifted(*moved) : std::nullopt;
        return Found{shifted ? std::move(*shifted) : std::move(*moved), false};
      }
    auto shifted = find_shifted({});
    return shifted ? std::optional(Found{std::move(*shifted), false}) : std::nullopt;
  }

  /// The whole surface shifted off the other one. @param off vertices displaced to the right side; none: to either side
  std::optional<std::vector<Vec3>> find_shifted(Span<const Vec3> off) {
    const FacePairs* near = few_near();
    if (!near) return std::nullopt;
    // A part that pierces a foil must be shifted further than the depth of the overlap.
    const auto way_with = [&](double share) {
      return std::min(max_length_, request_.depth + share * request_.tolerance);
    };
    return shifted_ghost({own_.tree,
                          other_.tree,
                          &displaced_,
                          near,
                          off,
                          {way_with(kGaps[0]), way_with(kGhostLength)},
                          kTouching * request_.tolerance,
                          overlaps()});
  }

  /// Vertices where fewer patches are retracted than overlap: along the edge between two patches, points that are
  /// nearest to one of them get out through the other one as well. One patch after another is left where it is, or,
  /// where that is better, follows its neighbours, as long as fewer faces meet.
  std::optional<Found> retract_chosen() {
    const std::vector<std::uint32_t> patches = overlapping_patches();
    if (patches.size() < 2 || patches.size() > kMaxPatches) return std::nullopt;
    std::vector<double> chosen = needed(kMargins[0]);
    const auto vertices_with = [&](std::uint32_t patch, double retraction) {
      std::vector<double> changed = chosen;
      set_patch(changed, patch, retraction);
      return retracted(changed);
    };
    const std::size_t end = displaced_.tests() + kMaxTests;
    DisplacedFaces::Meeting meeting = displaced_.meeting(retracted(chosen));
    bool into_solid = true;
    for (std::size_t round = 0; round < patches.size(); ++round) {
      struct Better {
        std::uint32_t patch;
        double retraction;
        DisplacedFaces::Meeting meeting;
      };
      std::optional<Better> best;
      for (const std::uint32_t patch : patches)
        for (const double other : {0.0, kFollowsOthers}) {
          const std::size_t fewest = best ? best->meeting.total : meeting.total;
          if (fewest == 0 || chosen[patch] <= other) continue;
          if (displaced_.tests() > end) return std::nullopt;
          auto less = displaced_.meeting_less(meeting, vertices_with(patch, other), fewest);
          if (less) best = {patch, other, std::move(*less)};
        }
      if (!best) return std::nullopt;
      into_solid = into_solid && best->retraction == 0;
      set_patch(chosen, best->patch, best->retraction);
      meeting = std::move(best->meeting);
      if (meeting.total > 0) continue;
      if (!apart(meeting.vertices) || !shallow(meeting.vertices)) return std::nullopt;
      return Found{std::move(meeting.vertices), into_solid};
    }
    return std::nullopt;
  }

  /// The vertices, displaced by the shortest vectors that retract their faces.
  std::vector<Vec3> retracted(const std::vector<double>& needed) const {
    const double usual = kGaps[0] * request_.tolerance;
    return surface().retracted({needed, usual, usual, max_length_});
  }

  /// Found when it is first wanted: most pairs need none.
  const RetractableSurface& surface() const {
    const SolidTree& own = *own_.tree;
    if (!surface_) surface_.emplace(own.vertices, outward_faces(own.faces, own.inside_out));
    return *surface_;
  }

  const OverlapRetraction& retraction() const { return overlap_.retraction(is_a_); }

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

  /// True if no face, moving in a straight line to its displaced position, passes a point that is deeper in this
  /// component than the pair may be. Every such point is then still inside the displaced surface, however long the
  /// displacements are.
  bool shallow(const std::vector<Vec3>& vertices) const {
    if (max_length_ <= depth_limit_ * (own_.is_sheet() ? kMaxFactorForCorners : 1) * (1 + kRounding)) return true;
    if (own_.is_sheet()) return false;
    const SolidTree& own = *own_.tree;
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

  bool apart(const std::vector<Vec3>& vertices) const { return displaced_.apart(vertices, overlaps()); }

  /// The pairs of faces that may have to be displaced off each other; null where they are too many.
  const FacePairs* few_near() {
    const double reach = max_length_ + kGaps[0] * request_.tolerance;
    if (!too_many_near_ && reach > near_reach_) {
      // Where the shortest displacements were not enough, somewhat longer ones will be tried as well.
      near_reach_ = near_reach_ > 0 ? std::max(reach, kMaxFactorForCorners * near_reach_) : reach;
      near_ = near_faces(*own_.tree, near_reach_, kMaxNear);
      too_many_near_ = near_.size() > kMaxNear;
    }
    return too_many_near_ ? nullptr : &near_;
  }

  FacePairs near_faces(const SolidTree& surface, double reach,
                       std::size_t most = std::numeric_limits<std::size_t>::max()) const {
    return near_face_pairs({&surface, other_.tree, reach, request_.tolerance, request_.kernels, most});
  }

  const OverlapSide& own_;
  const OverlapSide& other_;
  const SolidTree* usual_;
  const DisplacedFaces displaced_;
  const PairGhostRequest& request_;
  PairOverlap& overlap_;
  bool is_a_;
  mutable std::optional<RetractableSurface> surface_;
  FacePairs near_;
  double near_reach_ = 0;  // of `near_` [mm]
  double depth_limit_ = 0;
  double max_length_ = 0;  // of displacements [mm]
  bool too_many_near_ = false;
  bool tried_coaxial_ = false;
};

double longest_displacement(const SolidTree& component, const std::vector<Vec3>& displaced) {
  double longest = 0;
  for (std::size_t v = 0; v < displaced.size(); ++v)
    longest = std::max(longest, length(displaced[v] - component.vertices[v]));
  return longest;
}

}  // namespace

std::optional<PairGhosts> find_pair_ghosts(const PairGhostRequest& request) {
  PairOverlap overlap(request.a, request.b, request.depth, request.tolerance);
  GhostSide a(request, overlap, true), b(request, overlap, false);
  const double turning = overlap.turning();
  const bool can_turn = turning <= kPlay * request.tolerance;
  const bool usual = request.depth <= request.tolerance && can_turn && a.usual_is_apart() && b.usual_is_apart();
  const double play = std::min(kPlay / kOverlap * overlap_from(request), kPlay * request.tolerance);
  if (usual && request.depth <= play) return PairGhosts{};
  const double limit = std::max(request.depth, turning) + kGhostLength * request.tolerance;
  std::optional<GhostSide::Found> of_a, of_b;
  for (const double factor : kFactors) {
    const double length = factor * limit;
    if (factor > 1 && passes_thin_part(request, length)) break;
    const bool also_corners = factor <= kMaxFactorForCorners;
    if (!of_a) of_a = a.find(length, limit, also_corners);
    if (of_a && !of_b) of_b = b.find(length, limit, also_corners);
    if (of_a && of_b) {
      const double longest = std::max({length, longest_displacement(*request.a.tree, of_a->vertices),
                                       longest_displacement(*request.b.tree, of_b->vertices)});
      return PairGhosts{{std::move(of_a->vertices), std::move(of_b->vertices)},
                        longest,
                        can_turn ? 0 : turning,
                        of_a->retracted && of_b->retracted};
    }
  }
  return usual ? std::optional(PairGhosts{}) : std::nullopt;
}

}  // namespace dismantle
