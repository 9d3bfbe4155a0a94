// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/assembly_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace dismantle {

namespace {

constexpr std::array<Color, 10> kPalette{{{0.55f, 0.67f, 0.80f},
                                          {0.86f, 0.70f, 0.45f},
                                          {0.62f, 0.76f, 0.58f},
                                          {0.80f, 0.56f, 0.53f},
                                          {0.72f, 0.74f, 0.77f},
                                          {0.68f, 0.60f, 0.78f},
                                          {0.47f, 0.70f, 0.70f},
                                          {0.88f, 0.80f, 0.58f},
                                          {0.58f, 0.60f, 0.66f},
                                          {0.82f, 0.65f, 0.72f}}};
constexpr Color kGhost{0.60f, 0.64f, 0.70f, 0.13f};
constexpr float kGhostEdgeOpacity = 0.22f;
constexpr int kArrowSides = 24;

bool all_default_colored(const Assembly& assembly) {
  return std::all_of(assembly.components.begin(), assembly.components.end(),
                     [](const Component& c) { return c.color == Color{}; });
}

/// A circle of vertices of a swept surface.
struct Ring {
  Vec3 center;
  Vec3 first, second;  ///< Orthonormal vectors in its plane.
  double radius = 0;
};

/// The closed surface through rings, of which the first and the last have radius 0.
TriangleMesh lofted(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  constexpr auto kSides = static_cast<std::uint32_t>(kArrowSides);
  for (const Ring& ring : rings) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / kSides;
      mesh.vertices.push_back(ring.center +
                              ring.radius * (std::cos(angle) * ring.first + std::sin(angle) * ring.second));
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = ring * kSides + i, b = ring * kSides + (i + 1) % kSides;
      mesh.faces.push_back({{a, b, b + kSides}});
      mesh.faces.push_back({{a, b + kSides, a + kSides}});
    }
  }
  return clean_mesh(mesh).mesh;  // the first and the last ring collapse to points
}

/// The polyline of an arrow, cut where the head begins.
struct ShaftAndHead {
  std::vector<Vec3> shaft;  ///< Up to the base of the head.
  Vec3 tip;
};

/// @param head_length [mm]
ShaftAndHead cut_head(Span<const Vec3> points, double head_length) {
  ShaftAndHead cut{{points.begin(), points.end()}, points[points.size() - 1]};
  double left = head_length;
  while (cut.shaft.size() > 2 && length(cut.shaft.back() - cut.shaft[cut.shaft.size() - 2]) <= left) {
    left -= length(cut.shaft.back() - cut.shaft[cut.shaft.size() - 2]);
    cut.shaft.pop_back();
  }
  const Vec3 last = cut.shaft.back() - cut.shaft[cut.shaft.size() - 2];
  cut.shaft.back() -= std::min(left, 0.9 * length(last)) * normalized(last);
  return cut;
}

/// Tangent of a polyline at a point: the mean direction of the segments before and after it.
Vec3 direction_at(const std::vector<Vec3>& points, std::size_t i) {
  const Vec3 before = i > 0 ? normalized(points[i] - points[i - 1]) : Vec3{};
  const Vec3 after = i + 1 < points.size() ? normalized(points[i + 1] - points[i]) : Vec3{};
  return length(before + after) > 1e-6 ? normalized(before + after) : before;  // the polyline may reverse
}

}  // namespace

RenderScene make_scene(const Assembly& assembly, const AssemblySceneOptions& options) {
  DISMANTLE_EXPECT(options.poses.empty() || options.poses.size() == assembly.components.size());
  const Vec3 center = assembled_bounds(assembly).center();
  const bool use_palette = assembly.components.size() > 1 && all_default_colored(assembly);
  std::unordered_map<const TriangleMesh*, std::shared_ptr<const RenderMesh>> prepared;
  RenderScene scene;
  for (std::size_t i = 0; i < assembly.components.size(); ++i) {
    const Component& c = assembly.components[i];
    auto& mesh = prepared[c.mesh.get()];
    if (!mesh) mesh = std::make_shared<const RenderMesh>(make_render_mesh(*c.mesh, options.crease_angle));
    RenderItem item;
    item.mesh = mesh;
    item.world_from_mesh = c.assembly_from_mesh;
    if (!options.poses.empty()) item.world_from_mesh = transform_from_pose(options.poses[i]) * item.world_from_mesh;
    const Aabb box = assembled_bounds(c);
    if (options.explode != 0 && !box.empty())
      item.world_from_mesh.translation += options.explode * (box.center() - center);
    item.color = use_palette ? kPalette[i % kPalette.size()] : c.color;
    item.closed = c.faults.closed() && !c.faults.inside_out;
    scene.items.push_back(std::move(item));
  }
  return scene;
}

std::vector<Vec3> item_points(Span<const RenderItem> items) {
  std::vector<Vec3> points;
  for (const RenderItem& item : items)
    for (const Vec3& p : item.mesh->mesh.vertices) points.push_back(item.world_from_mesh * p);
  return points;
}

void make_ghost(RenderItem& item) {
  item.color = kGhost;
  item.edge_opacity = kGhostEdgeOpacity;
}

void make_highlighted(RenderItem& item, const Color& color) {
  item.color = color;
  item.color.a = 1;
}

RenderItem make_arrow(Vec3 from, Vec3 to, double radius, const Color& color) {
  const std::vector<Vec3> points{from, to};
  return make_curved_arrow(points, radius, color);
}

RenderItem make_curved_arrow(Span<const Vec3> points, double radius, const Color& color) {
  DISMANTLE_EXPECT(points.size() >= 2 && radius > 0);
  double total_length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    DISMANTLE_EXPECT(!(points[i] == points[i - 1]));
    total_length += length(points[i] - points[i - 1]);
  }
  const ShaftAndHead parts = cut_head(points, std::min(6 * radius, 0.5 * total_length));
  const Vec3 origin = points[0];
  const Vec3 start = direction_at(parts.shaft, 0);
  Vec3 first = normalized(cross(std::abs(start.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, start));
  std::vector<Ring> rings;
  const auto add = [&](Vec3 point, Vec3 direction, double ring_radius) {
    first = normalized(first - dot(first, direction) * direction);  // parallel transport: no twist about the tangent
    rings.push_back({point - origin, first, cross(direction, first), ring_radius});
  };
  add(parts.shaft[0], start, 0);
  for (std::size_t i = 0; i < parts.shaft.size(); ++i) add(parts.shaft[i], direction_at(parts.shaft, i), radius);
  const Vec3 end = normalized(parts.tip - parts.shaft.back());
  add(parts.shaft.back(), end, 2.5 * radius);
  add(parts.tip, end, 0);

  RenderItem item;
  item.mesh = std::make_shared<const RenderMesh>(make_render_mesh(lofted(rings)));
  item.world_from_mesh.translation = origin;
  item.color = color;
  item.edge_opacity = 0;
  item.closed = true;
  item.overlay = true;
  item.section = false;
  return item;
}

SectionPlane section_facing(const Camera& camera, Vec3 direction, Vec3 point) {
  SectionPlane plane;
  plane.normal = normalized(direction);
  const Vec3 towards_eye = camera.eye - camera.target;
  if (dot(plane.normal, towards_eye) < 0) plane.normal = -plane.normal;
  plane.offset = dot(plane.normal, point);
  return plane;
}

}  // namespace dismantle
