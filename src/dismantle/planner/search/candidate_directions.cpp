// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/candidate_directions.h"

#include "dismantle/math/nearest_twist.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

constexpr std::size_t kMaxDirections = 32;
/// Number of normal clusters that are combined in pairs.
constexpr std::size_t kMaxPaired = 16;
/// Distance at which faces count as touching, first [tolerances] and at most [share of the component's size].
constexpr double kFirstReach = 2;
constexpr double kLargestReach = 0.05;
constexpr double kReachGrowth = 4;
/// Number of face pairs that is enough.
constexpr std::size_t kEnoughContacts = 64;
/// Faces oppose each other if the cosine of their normals is below this.
constexpr double kFacing = -0.95;
/// Weight of pairs of faces that do not oppose each other, and how many of them count: those of the largest faces.
constexpr double kEdgeWeight = 1e-3;
constexpr std::size_t kMostEdges = 256;
/// A direction that opposes a normal by more than this [cosine] is blocked by it,
constexpr double kAgainst = 1e-4;
/// and one that opposes it by less is parallel to the face up to rounding.
constexpr double kAlmostAlong = 0.02;
/// A direction that separates faces at this rate [percent] separates them for the most part.
constexpr double kMax = 50;
/// An axis within this angle of a plane face's normal is that normal [rad].
constexpr double kSnap = 2e-3;
/// Of directions within this angle [rad] the first is kept: those of plane faces are the most exact.
constexpr double kSame = 1e-3;

Vec3 assembled_area(const Component& component, FaceId face) {
  return component.assembly_from_mesh.rotation * (0.5 * normal_unscaled(component.mesh->triangle(face.value)));
}

ContactNormals gather(const Assembly& assembly, const CertificateEngine& engine,
                      const std::vector<NearFaces>& contacts) {
  DirectionClusters facing(Sense::Directed), other(Sense::Directed);
  std::map<ComponentId, DirectionClusters> facing_of;
  std::vector<std::pair<double, NearFaces>> edges;
  ContactNormals result;
  for (const NearFaces& c : contacts) {
    const Vec3 moving = assembled_area(assembly[c.moving], c.face_moving);
    const Vec3 fixed = assembled_area(assembly[c.fixed], c.face_fixed);
    const double area_moving = length(moving), area_fixed = length(fixed);
    const double weight = std::min(area_moving, area_fixed);
    if (!(weight > 0)) continue;
    result.neighbours.insert(c.fixed);
    if (dot(moving, fixed) < kFacing * area_moving * area_fixed) {
      const Vec3 normal = area_moving > area_fixed ? -moving : fixed;
      facing.add(normal, weight);
      facing_of.try_emplace(c.fixed, Sense::Directed).first->second.add(normal, weight);
    } else {
      edges.emplace_back(weight, c);
    }
  }
  if (edges.size() > kMostEdges) {
    std::stable_sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    edges.resize(kMostEdges);
  }
  for (const auto& [weight, c] : edges)
    if (const Vec3 normal = engine.contact(c).normal; length(normal) > 0) other.add(normal, kEdgeWeight * weight);
  result.facing = facing.heaviest(4 * kMaxPaired);
  result.other = other.heaviest(kMaxPaired);
  for (const auto& [neighbour, normals] : facing_of) result.facing_of[neighbour] = normals.heaviest(kMaxPaired);
  return result;
}

/// Collects directions without repeats.
class Candidates {
 public:
  explicit Candidates(const ContactNormals& contacts) : contacts_(contacts) {}

  void add(const Vec3& direction) {
    if (!(length(direction) > 0)) return;
    const Vec3 unit = along_faces(normalized(direction));
    for (const Vec3& known : list_)
      if (length(known - unit) < kSame) return;
    list_.push_back(unit);
  }
  void add_axis(const Vec3& axis) {
    add(axis);
    add(-axis);
  }
  bool free(const Vec3& d) const { return blocked_weight(d) == 0; }

  /// Directions that the contacts allow first, and of those the ones that separate most of them.
  std::vector<CandidateDirection> ranked() const {
    std::vector<std::pair<Rank, Vec3>> ranks;
    ranks.reserve(list_.size());
    for (const Vec3& d : list_) ranks.emplace_back(Rank{blocked_weight(d), opening(d)}, d);
    std::stable_sort(ranks.begin(), ranks.end(), [](const auto& a, const auto& b) {
      return a.first.blocked != b.first.blocked ? a.first.blocked < b.first.blocked : a.first.opening > b.first.opening;
    });
    if (ranks.size() > kMaxDirections) ranks.resize(kMaxDirections);
    std::vector<CandidateDirection> result;
    result.reserve(ranks.size());
    for (const auto& [rank, d] : ranks) result.push_back({d, rank.blocked == 0 && rank.opening >= kMax});
    return result;
  }

 private:
  struct Rank {
    double blocked, opening;
  };
  double blocked_weight(const Vec3& d) const {
    double weight = 0;
    for (const WeightedDirection& n : contacts_.facing)
      if (dot(n.direction, d) < -kAgainst) weight += n.weight;
    return weight;
  }
  /// Rate at which the contact faces separate, in whole percent, so that smaller differences are ties.
  double opening(const Vec3& d) const {
    double sum = 0, weight = 0;
    for (const WeightedDirection& n : contacts_.facing) {
      sum += n.weight * std::max(0.0, dot(n.direction, d));
      weight += n.weight;
    }
    return weight > 0 ? std::round(100 * sum / weight) : 0;
  }
  /// The direction nearest to `d` that enters none of the faces nearly parallel to it; `d` if these contradict each
  /// other.
  Vec3 along_faces(const Vec3& d) const {
    std::vector<HalfSpace> faces;
    for (const WeightedDirection& n : contacts_.facing) {
      const double cosine = dot(n.direction, d);
      if (std::abs(cosine) < kAlmostAlong) faces.push_back({{n.direction.x, n.direction.y, n.direction.z, 0, 0, 0}, 0});
    }
    const double wanted[6] = {d.x, d.y, d.z, 0, 0, 0};
    const NearestTwist nearest = nearest_twist(wanted, faces);
    const Vec3 found{nearest.x[0], nearest.x[1], nearest.x[2]};
    return length(found) > 0.9 ? normalized(found) : d;
  }

  const ContactNormals& contacts_;
  std::vector<Vec3> list_;
};

/// The extreme rays of the cone of directions that no contact face opposes, and their sum.
void add_cone(const ContactNormals& contacts, Candidates& candidates) {
  const std::size_t count = std::min(contacts.facing.size(), kMaxPaired);
  Vec3 rays, normals;
  for (std::size_t i = 0; i < count; ++i) {
    normals += contacts.facing[i].weight * contacts.facing[i].direction;
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3 axis = cross(contacts.facing[i].direction, contacts.facing[j].direction);
      if (length(axis) < kAlmostAlong) continue;
      for (const Vec3& ray : {normalized(axis), -normalized(axis)}) {
        if (!candidates.free(ray)) continue;
        candidates.add(ray);
        rays += ray;
      }
    }
  }
  candidates.add(rays);
  candidates.add(normals);
}

/// The normal of the plane face perpendicular to an axis, if there is one: planes are more exact.
Vec3 snapped(const Vec3& axis, const ShapeFeatures& features) {
  for (const WeightedDirection& n : features.normals)
    if (length(n.direction - axis) < kSnap || length(n.direction + axis) < kSnap) return n.direction;
  return axis;
}

}  // namespace

ContactNormals contact_normals(const PlannedAssembly& planned, const CertificateEngine& engine, ComponentId component) {
  const double most = kLargestReach * planned.features[component.value].radius;
  std::vector<NearFaces> contacts;
  for (double reach = kFirstReach * planned.tolerance; contacts.size() < kEnoughContacts; reach *= kReachGrowth) {
    contacts = engine.near_faces(component, reach);
    if (reach > most) break;
  }
  return gather(planned.assembly, engine, contacts);
}

std::vector<ComponentId> neighbours_against(const ContactNormals& contacts, const Vec3& direction) {
  std::vector<ComponentId> against;
  for (const auto& [neighbour, normals] : contacts.facing_of)
    if (std::any_of(normals.begin(), normals.end(),
                    [&](const WeightedDirection& n) { return dot(n.direction, direction) < -kAlmostAlong; }))
      against.push_back(neighbour);
  return against;
}

std::vector<CandidateDirection> candidate_directions(ComponentId component, const ContactNormals& contacts,
                                                     Span<const ShapeFeatures> features) {
  Candidates candidates(contacts);
  const ShapeFeatures& own = features[component.value];
  for (const WeightedDirection& axis : own.axes) candidates.add_axis(snapped(axis.direction, own));
  for (const WeightedDirection& n : contacts.facing) candidates.add(n.direction);
  for (const WeightedDirection& n : own.normals) candidates.add_axis(n.direction);
  for (const ComponentId c : contacts.neighbours)
    for (std::size_t k = 0; k < std::min<std::size_t>(3, features[c.value].axes.size()); ++k)
      candidates.add_axis(features[c.value].axes[k].direction);
  add_cone(contacts, candidates);
  for (const WeightedDirection& n : contacts.other) candidates.add(n.direction);
  return candidates.ranked();
}

}  // namespace dismantle
