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

/// A solid of revolution about z: rings of (radius, z) from the bottom tip to the top tip.
TriangleMesh revolved(const std::vector<std::array<double, 2>>& profile) {
  TriangleMesh mesh;
  constexpr auto kSides = static_cast<std::uint32_t>(kArrowSides);
  for (const auto& [radius, z] : profile) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::acos(-1.0) * i / kSides;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = ring * kSides + i, b = ring * kSides + (i + 1) % kSides;
      mesh.faces.push_back({{a, b, b + kSides}});
      mesh.faces.push_back({{a, b + kSides, a + kSides}});
    }
  }
  return clean_mesh(mesh).mesh;  // the tips' rings shrink to points
}

}  // namespace

RenderScene make_scene(const Assembly& assembly, const AssemblySceneOptions& options) {
  DISMANTLE_EXPECT(options.poses.empty() || options.poses.size() == assembly.components.size());
  const Vec3 middle = assembled_bounds(assembly).center();
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
      item.world_from_mesh.translation += options.explode * (box.center() - middle);
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
  DISMANTLE_EXPECT(!(from == to) && radius > 0);
  const double arrow_length = length(to - from);
  const double head = std::min(6 * radius, 0.5 * arrow_length);
  const Vec3 z = normalized(to - from);
  const Vec3 x = normalized(cross(std::abs(z.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, z));
  RenderItem item;
  item.mesh = std::make_shared<const RenderMesh>(make_render_mesh(revolved(
      {{0, 0}, {radius, 0}, {radius, arrow_length - head}, {2.5 * radius, arrow_length - head}, {0, arrow_length}})));
  item.world_from_mesh = {transposed(Mat3{{x, cross(z, x), z}}), from};
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
