// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/coaxial_ghost.h"

#include "dismantle/certificates/ghosts/profile_along_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Two axes have one direction if the sine of the angle between them is no larger than this.
constexpr double kSameDirection = 1e-3;
/// So many common axes are tried.
constexpr std::size_t kMaxAxes = 3;
/// Faces whose normals are this nearly along the axis belong neither to an outer surface nor to a bore.
constexpr double kAcross = 0.05;

/// Distances from a surface are looked up to this many times the depth of the pair.
constexpr double kBeyondDepth = 1.1;
/// Vertices are deep if they are deeper than this many times the depth that one of these shares of all vertices that
/// are inside does not exceed.
constexpr double kDeepShare = 1.6;
constexpr double kShares[] = {0.5, 0.75, 0.9};
/// Elsewhere, the depth is at most this share of that of the pair, and the range is at most this share of the length
/// along which the two overlap.
constexpr double kShallowShare = 0.5, kShortShare = 0.5;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A range of distances from an axis, or of positions along it [mm].
struct Range {
  double low = kInfinite, high = -kInfinite;
  void extend(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

bool overlap(const Range& a, const Range& b) {
  return a.low <= b.high && b.low <= a.high;
}

enum class Side : std::uint8_t { Across, Outer, Bore };

/// Where a face lies about an axis.
struct FacePlace {
  Range along;     // the axis
  Range distance;  // from it
  Side side = Side::Across;
};

FacePlace place_of(const AxisFrame& axis, const SolidTree& tree, std::uint32_t face) {
  FacePlace place;
  const Triangle t = tree.triangle(face);
  Vec3 corners[3];
  for (int i = 0; i < 3; ++i) {
    place.along.extend(axis.along(t[i]));
    corners[i] = axis.across(t[i]);
    place.distance.extend(length(corners[i]));
  }
  for (int i = 0; i < 3; ++i) place.distance.extend(AxisFrame::distance_of_segment(corners[i], corners[(i + 1) % 3]));
  const Vec3 normal = (tree.inside_out ? -1.0 : 1.0) * normal_unscaled(t),
             middle = corners[0] + corners[1] + corners[2];
  const double away = dot(normal, middle);
  if (std::abs(away) > kAcross * length(normal) * length(middle)) place.side = away > 0 ? Side::Outer : Side::Bore;
  return place;
}

std::vector<FacePlace> places_of(const AxisFrame& axis, const SolidTree& tree) {
  std::vector<FacePlace> places;
  for (std::uint32_t f = 0; f < tree.faces.size(); ++f) places.push_back(place_of(axis, tree, f));
  return places;
}

Range along_of(const std::vector<FacePlace>& places) {
  Range along;
  for (const FacePlace& place : places) {
    along.extend(place.along.low);
    along.extend(place.along.high);
  }
  return along;
}

/// The ghost of one component about one axis.
class Coaxial {
 public:
  explicit Coaxial(const CoaxialRequest& request)
      : request_(request),
        tree_(*request.own->tree),
        axis_(request.axis.point, request.axis.direction),
        own_(places_of(axis_, tree_)),
        other_(places_of(axis_, *request.other->tree)),
        first_(request.surface->first()),
        displaced_(request.start.size()) {}

  /// @return the first vertices that are good
  std::optional<std::vector<Vec3>> find(const std::function<bool(const std::vector<Vec3>&)>& good) {
    std::vector<Triangle> bores, shafts;
    find_profiles(bores, shafts);
    const ProfileAlongAxis bore(axis_, bores, false), shaft(axis_, shafts, true);
    const std::vector<bool> of_outer = vertices_of(Side::Outer), of_bore = vertices_of(Side::Bore);
    // Cracks must not open: vertices beside them stay, and those at one position move alike.
    const std::vector<bool>& stays = request_.surface->beside_open_edge();
    std::vector<bool> inwards(of_outer.size()), outwards(of_outer.size());
    for (std::size_t v = 0; v < of_outer.size(); ++v) {
      const bool may = !stays[v] && first_[v] == v && (request_.movable.empty() || request_.movable[v]);
      inwards[v] = of_outer[v] && !of_bore[v] && may;
      outwards[v] = of_bore[v] && !of_outer[v] && may;
    }
    const auto beside_bore = edges_at(inwards), beside_shaft = edges_at(outwards);
    for (const double gap : request_.gaps) {
      displaced_ = request_.start;
      move(bore, inwards, beside_bore, -gap);
      move(shaft, outwards, beside_shaft, gap);
      for (std::size_t v = 0; v < first_.size(); ++v) displaced_[v] = displaced_[first_[v]];
      if (good(displaced_)) return std::move(displaced_);
    }
    return std::nullopt;
  }

 private:
  using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  /// The faces of the other component that the own ones have to get past.
  void find_profiles(std::vector<Triangle>& bores, std::vector<Triangle>& shafts) const {
    const Range beside_own = along_of(own_), beside_other = along_of(other_);
    double own_bore = kInfinite;
    for (const FacePlace& place : own_)
      if (place.side == Side::Bore && overlap(place.along, beside_other))
        own_bore = std::min(own_bore, place.distance.low);
    const double reached = own_bore + request_.max_length;
    for (std::uint32_t f = 0; f < other_.size(); ++f) {
      const FacePlace& place = other_[f];
      if (!request_.whole && !overlap(place.along, beside_own)) continue;
      if (place.side == Side::Bore) bores.push_back(request_.other->tree->triangle(f));
      if (place.side == Side::Outer && place.distance.high <= reached)
        shafts.push_back(request_.other->tree->triangle(f));
    }
  }

  /// For the first vertex at each position, if it belongs to a face of that side.
  std::vector<bool> vertices_of(Side side) const {
    std::vector<bool> belongs(displaced_.size());
    for (std::size_t f = 0; f < own_.size(); ++f)
      if (own_[f].side == side)
        for (const std::uint32_t v : tree_.faces[f].v) belongs[first_[v]] = true;
    return belongs;
  }

  /// The edges with an end that may be moved, each once.
  Edges edges_at(const std::vector<bool>& may_move) const {
    Edges edges;
    for (const Face& f : tree_.faces)
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t v = first_[f.v[i]], w = first_[f.v[(i + 1) % 3]];
        if (may_move[v] || may_move[w]) edges.push_back(std::minmax(v, w));
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  /// Moves vertices straight towards or away from the axis, past the profile of the other component.
  /// @param may_move the vertices that may be moved @param edges edges_at() these
  /// @param gap from that profile: above 0 to be beyond it, below 0 to be within it [mm]
  void move(const ProfileAlongAxis& profile, const std::vector<bool>& may_move, const Edges& edges, double gap) {
    const bool outwards = gap > 0;
    for (std::size_t v = 0; v < may_move.size(); ++v) {
      if (!may_move[v]) continue;
      const Vec3 across = axis_.across(tree_.vertices[v]);
      const auto beyond = profile.distance(axis_.angle(across));
      if (beyond && *beyond + gap > 0 && (*beyond + gap > length(across)) == outwards) set(v, *beyond + gap);
    }
    // Between their corners, faces may still be in the way.
    std::vector<double> ratios(may_move.size(), 1);
    for (const auto& [v, w] : edges) {
      const double ratio = profile.ratio_to_segment(axis_.across(displaced_[v]), axis_.across(displaced_[w]));
      for (const std::uint32_t corner : {v, w})
        ratios[corner] = outwards ? std::max(ratios[corner], ratio) : std::min(ratios[corner], ratio);
    }
    for (std::size_t v = 0; v < may_move.size(); ++v)
      if (may_move[v] && ratios[v] != 1) set(v, ratios[v] * length(axis_.across(displaced_[v])) + gap);
  }

  /// Moves a vertex to a distance from the axis, unless that is too far or too deep.
  void set(std::size_t v, double distance) {
    const Vec3 across = axis_.across(displaced_[v]);
    if (!(length(across) > 0)) return;
    const Vec3 moved = displaced_[v] + (distance / length(across) - 1) * across;
    if (length(moved - tree_.vertices[v]) > request_.max_length) return;
    if (request_.own->shape().surface().distance(moved, 0, 2 * request_.depth_limit).distance > request_.depth_limit)
      return;
    displaced_[v] = moved;
  }

  const CoaxialRequest& request_;
  const SolidTree& tree_;
  const AxisFrame axis_;
  std::vector<FacePlace> own_, other_;
  const std::vector<std::uint32_t>& first_;  // vertex at each vertex's position
  std::vector<Vec3> displaced_;
};

}  // namespace

std::vector<RevolutionAxis> common_axes(const SolidTree& a, const SolidTree& b, double within) {
  std::vector<RevolutionAxis> common;
  if (!a.revolution || !b.revolution) return common;
  for (const SolidTree* tree : {&a, &b})
    for (const RevolutionAxis& axis : tree->revolution->axes()) {
      const auto same = [&](const RevolutionAxis& other) { return same_axis(axis, other, kSameDirection, within); };
      const auto has = [&](const SolidTree& component) {
        const Span<const RevolutionAxis> axes = component.revolution->axes();
        return std::any_of(axes.begin(), axes.end(), same);
      };
      if (common.size() < kMaxAxes && std::none_of(common.begin(), common.end(), same) && has(a) && has(b))
        common.push_back(axis);
    }
  return common;
}

std::vector<DeepRange> deep_ranges(const OverlapSide& a, const OverlapSide& b, const RevolutionAxis& axis, double least,
                                   double depth) {
  const AxisFrame frame(axis.point, axis.direction);
  struct Inside {
    double along, depth;
  };
  std::vector<Inside> inside;
  Range all;
  const auto look_at = [&](const OverlapSide& own, const SolidShape& other) {
    const double farthest = kBeyondDepth * depth;
    for (const Vec3 p : own.tree->vertices) {
      Aabb at;
      at.extend(p);
      if (!overlaps(other.surface().bounds(), at)) continue;
      const double distance = other.surface().distance(p, 0, farthest).distance;
      if (distance <= least || distance >= farthest || !other.winding().inside(p)) continue;
      inside.push_back({frame.along(p), distance});
      all.extend(inside.back().along);
    }
  };
  look_at(a, b.shape());
  look_at(b, a.shape());
  std::sort(inside.begin(), inside.end(), [](Inside x, Inside y) { return x.depth < y.depth; });
  std::vector<DeepRange> ranges;
  for (const double share : kShares) {
    if (inside.empty()) break;
    const auto most = static_cast<std::size_t>(share * static_cast<double>(inside.size()));
    DeepRange range{kInfinite, -kInfinite, kDeepShare * inside[most].depth};
    if (range.elsewhere > kShallowShare * depth) break;
    for (const Inside& vertex : inside) {
      if (vertex.depth <= range.elsewhere) continue;
      range.begin = std::min(range.begin, vertex.along);
      range.end = std::max(range.end, vertex.along);
    }
    if (range.begin > range.end) break;
    if (range.end - range.begin <= kShortShare * (all.high - all.low)) ranges.push_back(range);
  }
  return ranges;
}

std::optional<std::vector<Vec3>> coaxial_ghost(const CoaxialRequest& request,
                                               const std::function<bool(const std::vector<Vec3>&)>& good) {
  return Coaxial(request).find(good);
}

}  // namespace dismantle
