// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/exposure.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dismantle {

namespace {

/// Number of rays from each point, and of those that have to be free.
constexpr std::size_t kRays = 24, kOpen = 6;
/// Number of points that are spread over the surface of a component, besides the outermost ones.
constexpr std::size_t kSpread = 32;
/// Multiples of these, modulo 1, are spread evenly over the unit square (the R2 sequence, from the plastic number).
constexpr double kSpreadX = 0.7548776662466927, kSpreadY = 0.5698402909980532;
/// Distance of the start of a ray from the surface, in diagonals of the component.
constexpr double kLift = 1e-6;
/// In Sample::blocker: the ray meets nothing; it was not tested.
constexpr std::uint32_t kFree = ComponentId::kInvalid, kUntested = kFree - 1;

/// Directions about the z axis, by the cosine of their angle with it: an equal share of the light from a uniformly
/// bright sky comes along each.
std::array<Vec3, kRays> sky() {
  std::array<Vec3, kRays> directions;
  for (std::size_t i = 0; i < kRays; ++i) {
    const double sine = std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(kRays));
    const double angle = static_cast<double>(i) * kTurn / (std::numbers::phi * std::numbers::phi);
    directions[i] = {sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1 - sine * sine)};
  }
  return directions;
}

/// The direction of a ray above a surface. @param frame of its normal
Vec3 direction_of(const AxisFrame& frame, std::size_t ray) {
  static const std::array<Vec3, kRays> kSky = sky();
  return kSky[ray].x * frame.first + kSky[ray].y * frame.second + kSky[ray].z * frame.direction;
}

double fraction(double x) {
  return x - std::floor(x);
}

/// A point of a face: its corners weighted.
struct FacePoint {
  std::size_t face;
  double weight[3];
};

/// The points of a mesh from which rays are cast: the centres of the outermost faces along many directions, and points
/// spread evenly over its area. @pre it has a face
std::vector<FacePoint> chosen_points(const TriangleMesh& mesh) {
  std::vector<Vec3> centers;
  std::vector<double> area_up_to;
  centers.reserve(mesh.faces.size());
  area_up_to.reserve(mesh.faces.size());
  double area = 0;
  for (const Face& f : mesh.faces) {
    const Vec3 a = mesh.vertices[f.v[0]], b = mesh.vertices[f.v[1]], c = mesh.vertices[f.v[2]];
    centers.push_back((a + b + c) / 3);
    area_up_to.push_back(area += length(cross(b - a, c - a)));
  }
  std::vector<std::size_t> outermost;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double z : {-1.0, 0.0, 1.0}) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 d{x, y, z};
        const auto found = std::max_element(centers.begin(), centers.end(),
                                            [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); });
        outermost.push_back(static_cast<std::size_t>(found - centers.begin()));
      }
  std::sort(outermost.begin(), outermost.end());
  outermost.erase(std::unique(outermost.begin(), outermost.end()), outermost.end());
  std::vector<FacePoint> chosen;
  chosen.reserve(outermost.size() + kSpread);
  for (const std::size_t face : outermost) chosen.push_back({face, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
  for (std::size_t i = 0; i < kSpread; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kSpread);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, share * area);
    double u = fraction(kSpreadX * static_cast<double>(i)), v = fraction(kSpreadY * static_cast<double>(i));
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    chosen.push_back({static_cast<std::size_t>(found - area_up_to.begin()), {1 - u - v, u, v}});
  }
  return chosen;
}

}  // namespace

Exposure::Exposure(const Assembly& assembly, Span<const ShapeFeatures> features)
    : assembly_(assembly), spheres_(sphere_tree(features)), tested_(assembly.components.size()) {
  for (const Component& component : assembly.components) meshes_.try_emplace(component.mesh.get());
}

std::vector<Exposure::Sample> Exposure::samples_of(ComponentId c) const {
  const Component& component = assembly_[c];
  const TriangleMesh& mesh = *component.mesh;
  std::vector<Sample> samples;
  if (mesh.faces.empty()) return samples;
  const double lift = kLift * diagonal(assembled_bounds(component));
  for (const FacePoint& at : chosen_points(mesh)) {
    const Face& f = mesh.faces[at.face];
    const Vec3 a = mesh.vertices[f.v[0]], b = mesh.vertices[f.v[1]], d = mesh.vertices[f.v[2]];
    const Vec3 center = component.assembly_from_mesh * (at.weight[0] * a + at.weight[1] * b + at.weight[2] * d);
    const Vec3 normal = component.assembly_from_mesh.rotation * normalized(cross(b - a, d - a));
    if (!component.faults.inside_out) samples.push_back({center + lift * normal, normal, {}});
    if (!component.faults.bounds_solid()) samples.push_back({center - lift * normal, -normal, {}});
  }
  return samples;
}

bool Exposure::is_exposed(ComponentId c, const ComponentSet& present) {
  Tested& tested = tested_[c.value];
  if (tested.state == State::Unknown) {
    tested.state = State::Enclosed;
    tested.samples = samples_of(c);
  }
  if (tested.state == State::Exposed) return true;
  for (Sample& sample : tested.samples)
    if (is_open(sample, c, present)) {
      tested = {State::Exposed, {}};
      return true;
    }
  return false;
}

std::optional<std::vector<ComponentId>> Exposure::opened_by(ComponentId c, const ComponentSet& present,
                                                            const ComponentSet& gone) {
  std::optional<std::vector<ComponentId>> least;
  for (const Sample& sample : samples_of(c)) {
    auto found = opened_by(sample, c, present, gone);
    if (found && (!least || found->size() < least->size())) least = std::move(found);
    if (least && least->size() <= 1) break;
  }
  return least;
}

std::optional<std::vector<ComponentId>> Exposure::opened_by(const Sample& sample, ComponentId own,
                                                            const ComponentSet& present, const ComponentSet& gone) {
  const AxisFrame frame(sample.point, sample.normal);
  std::vector<std::vector<ComponentId>> rays;  // of those that are free among `present`: what they meet of `gone`
  for (std::size_t i = 0; i < kRays && rays.size() + kRays - i >= kOpen; ++i) {
    const Vec3 ray = direction_of(frame, i);
    if (blocker(sample.point, ray, {&own, 1}, present).valid()) continue;
    std::vector<ComponentId>& met = rays.emplace_back();
    for_each_near(sample.point, ray, [&](ComponentId c) {
      if (gone.has(c) && meets(sample.point, ray, c)) met.push_back(c);
      return true;
    });
  }
  if (rays.size() < kOpen) return std::nullopt;
  std::stable_sort(rays.begin(), rays.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<ComponentId> met;
  for (std::size_t i = 0; i < kOpen; ++i) met.insert(met.end(), rays[i].begin(), rays[i].end());
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

bool Exposure::is_open(Sample& sample, ComponentId own, const ComponentSet& present) {
  const AxisFrame frame(sample.point, sample.normal);
  std::size_t open = 0, blocked = 0;
  ComponentId last = own;
  for (std::size_t i = 0; i < kRays && open < kOpen && blocked <= kRays - kOpen; ++i) {
    if (i == sample.blocker.size()) sample.blocker.push_back(kUntested);
    std::uint32_t& known = sample.blocker[i];
    if (known == kUntested || (known != kFree && !present.has(ComponentId(known)))) {
      const Vec3 ray = direction_of(frame, i);
      const std::array<ComponentId, 2> likely{own, last};
      known = blocker(sample.point, ray, {likely.data(), likely.size()}, present).value;
    }
    if (known == kFree) {
      ++open;
    } else {
      ++blocked;
      last = ComponentId(known);
    }
  }
  return open >= kOpen;
}

ComponentId Exposure::blocker(Vec3 point, Vec3 direction, Span<const ComponentId> likely, const ComponentSet& present) {
  for (const ComponentId c : likely)
    if (meets(point, direction, c)) return c;
  ComponentId found;
  for_each_near(point, direction, [&](ComponentId c) {
    if (present.has(c) && meets(point, direction, c)) found = c;
    return !found.valid();
  });
  return found;
}

template <class Visit>
void Exposure::for_each_near(Vec3 point, Vec3 direction, const Visit& visit) const {
  bool goes_on = true;
  // Infinite for spheres that the ray misses.
  const auto bound = [&](const BoundingSphere& sphere) {
    const Vec3 to = sphere.center - point;
    const double along = dot(to, direction), radius = 1.001 * sphere.radius;
    const bool may_meet = along >= -radius && length_squared(to) - along * along <= radius * radius;
    return may_meet ? 0 : std::numeric_limits<double>::infinity();
  };
  const auto limit = [&] { return goes_on ? 0.0 : -1.0; };
  spheres_.traverse(bound, limit, [&](std::uint32_t i) {
    if (goes_on) goes_on = visit(ComponentId(i));
  });
}

bool Exposure::meets(Vec3 point, Vec3 direction, ComponentId c) {
  const Component& component = assembly_[c];
  if (component.mesh->faces.empty()) return false;
  RayTree& rays = meshes_.at(component.mesh.get());
  std::call_once(rays.once, [&] { rays.tree.emplace(*component.mesh); });
  const RigidTransform mesh_from_assembly = inverse(component.assembly_from_mesh);
  return !rays.tree->for_each_hit(mesh_from_assembly * point, mesh_from_assembly.rotation * direction,
                                  [](std::uint32_t, RayHit) { return false; });
}

}  // namespace dismantle
