// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/project_scene.h"

#include "dismantle/geometry/aabb_corners.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

struct ClipVertex {
  Vec3 position;  // view frame
  Vec3f normal;
};

/// A triangle clipped by at most two planes: a convex polygon.
struct ClipPolygon {
  std::array<ClipVertex, 5> vertices;
  int count = 0;
};

ClipPolygon clipped(const ClipPolygon& polygon, const ViewPlane& plane) {
  ClipPolygon result;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipVertex& a = polygon.vertices[static_cast<std::size_t>(i)];
    const ClipVertex& b = polygon.vertices[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double beyond_a = dot(plane.normal, a.position) - plane.offset;
    const double beyond_b = dot(plane.normal, b.position) - plane.offset;
    if (beyond_a <= 0) result.vertices[static_cast<std::size_t>(result.count++)] = a;
    if ((beyond_a <= 0) == (beyond_b <= 0)) continue;
    const double s = beyond_a / (beyond_a - beyond_b);
    result.vertices[static_cast<std::size_t>(result.count++)] = {
        a.position + s * (b.position - a.position), a.normal + static_cast<float>(s) * (b.normal - a.normal)};
  }
  return result;
}

ViewTransform make_view(const Camera& camera, const RenderOptions& options) {
  ViewTransform view;
  view.axes = camera_axes(camera);
  view.eye = camera.eye;
  view.perspective = camera.projection == Projection::Perspective;
  const double samples_high = static_cast<double>(options.height) * options.samples;
  view.center_x = 0.5 * options.width * options.samples;
  view.center_y = 0.5 * samples_high;
  view.scale = view.perspective ? samples_high / 2 / std::tan(camera.field_of_view / 2) : samples_high / camera.height;
  view.near_depth = 1e-3 * length(camera.target - camera.eye);
  return view;
}

Layer layer_of(const RenderItem& item) {
  if (item.overlay) return Layer::Overlay;
  return item.color.a < 1 ? Layer::Transparent : Layer::Opaque;
}

/// Projects the triangles and edges of one item.
class ItemProjector {
 public:
  ItemProjector(const ProjectedScene& projected, const RenderScene& scene, std::uint32_t item,
                const RenderOptions& options)
      : view_(projected.view), item_(scene.items[item]), index_(item), options_(options) {
    if (view_.perspective) planes_.push_back({{0, 0, -1}, -view_.near_depth});
    if (projected.section && item_.section) planes_.push_back(*projected.section);
    const RenderMesh& m = *item_.mesh;
    positions_.reserve(m.mesh.vertices.size());
    for (const Vec3& p : m.mesh.vertices) positions_.push_back(view_.to_view(item_.world_from_mesh * p));
    normal_matrix_ = view_.axes * item_.world_from_mesh.rotation;
    // The near side of a closed item hides its far side, unless a section opens the item.
    skip_back_facing_ = item_.closed && item_.color.a < 1 && !(projected.section && item_.section);
  }

  void add_face(std::uint32_t face, std::vector<ScreenTriangle>& out) const {
    const RenderMesh& m = *item_.mesh;
    ClipPolygon polygon;
    polygon.count = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f n = m.corner_normals[3 * face + k];
      const Vec3 turned = normal_matrix_ * Vec3{n.x, n.y, n.z};
      polygon.vertices[k] = {
          positions_[m.mesh.faces[face].v[k]],
          {static_cast<float>(turned.x), static_cast<float>(turned.y), static_cast<float>(turned.z)}};
    }
    for (const ViewPlane& plane : planes_) polygon = clipped(polygon, plane);
    for (std::size_t k = 2; k < static_cast<std::size_t>(polygon.count); ++k)
      add_triangle({&polygon.vertices[0], &polygon.vertices[k - 1], &polygon.vertices[k]}, face, out);
  }

  void add_edge(const FeatureEdge& edge, std::vector<ScreenLine>& out) const {
    if (skip_back_facing_ && faces_away(edge.faces[0]) && faces_away(edge.faces[1])) return;
    ScreenLine line;
    line.color = options_.edge_color;
    line.color.a = item_.edge_opacity;
    line.half_width = 0.5f * options_.edge_width * static_cast<float>(options_.samples);
    line.item = index_;
    line.faces[0] = edge.faces[0];
    line.faces[1] = edge.faces[1];
    line.is_edge = true;
    add_clipped_line(view_, planes_, positions_[edge.vertices[0]], positions_[edge.vertices[1]], line, out);
  }

  /// Clips and projects a segment a-b of the view frame. @param line template without screen coordinates
  static void add_clipped_line(const ViewTransform& view, Span<const ViewPlane> planes, Vec3 a, Vec3 b, ScreenLine line,
                               std::vector<ScreenLine>& out) {
    for (const ViewPlane& plane : planes) {
      const double beyond_a = dot(plane.normal, a) - plane.offset, beyond_b = dot(plane.normal, b) - plane.offset;
      if (beyond_a > 0 && beyond_b > 0) return;
      if (beyond_a <= 0 && beyond_b <= 0) continue;
      (beyond_a > 0 ? a : b) = a + beyond_a / (beyond_a - beyond_b) * (b - a);
    }
    for (int k = 0; k < 2; ++k) {
      const Vec3 p = k == 0 ? a : b;
      const double scale = view.perspective ? view.scale / p.z : view.scale;
      line.x[k] = static_cast<float>(view.center_x + scale * p.x);
      line.y[k] = static_cast<float>(view.center_y - scale * p.y);
      line.key[k] = static_cast<float>(view.key_of_depth(p.z));
    }
    out.push_back(line);
  }

 private:
  bool faces_away(std::uint32_t face) const {
    const Face& f = item_.mesh->mesh.faces[face];
    const Vec3 a = positions_[f.v[0]];
    const Vec3 normal = cross(positions_[f.v[1]] - a, positions_[f.v[2]] - a);
    return (view_.perspective ? dot(normal, a) : normal.z) > 0;
  }

  void add_triangle(const std::array<const ClipVertex*, 3>& corners, std::uint32_t face,
                    std::vector<ScreenTriangle>& out) const {
    ScreenTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = corners[k]->position;
      const double weight = view_.perspective ? 1 / p.z : 1;
      t.x[k] = static_cast<float>(view_.center_x + view_.scale * weight * p.x);
      t.y[k] = static_cast<float>(view_.center_y - view_.scale * weight * p.y);
      t.key[k] = static_cast<float>(view_.key_of_depth(p.z));
      t.weight[k] = static_cast<float>(weight);
      t.normal[k] = corners[k]->normal;
    }
    const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
    if (!(right >= 0 && bottom >= 0 && left <= 2 * view_.center_x && top <= 2 * view_.center_y)) return;
    // Screen y points down, so a front-facing triangle runs clockwise.
    t.back_facing = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]) > 0;
    if (skip_back_facing_ && t.back_facing) return;
    t.item = index_;
    t.face = face;
    out.push_back(t);
  }

  const ViewTransform& view_;
  const RenderItem& item_;
  std::uint32_t index_;
  const RenderOptions& options_;
  std::vector<ViewPlane> planes_;
  std::vector<Vec3> positions_;
  Mat3 normal_matrix_;
  bool skip_back_facing_ = false;
};

/// The projected primitives of one item; items are projected in parallel and then concatenated in order.
struct ItemParts {
  std::vector<ScreenTriangle> triangles;
  std::vector<ScreenLine> lines;
};

ItemParts project_item(const ProjectedScene& projected, const RenderScene& scene, std::uint32_t index,
                       const RenderOptions& options) {
  const RenderItem& item = scene.items[index];
  const ItemProjector projector(projected, scene, index, options);
  ItemParts parts;
  parts.triangles.reserve(item.mesh->mesh.faces.size());
  for (std::uint32_t f = 0; f < item.mesh->mesh.faces.size(); ++f) projector.add_face(f, parts.triangles);
  if (item.edge_opacity > 0)
    for (const FeatureEdge& edge : item.mesh->feature_edges) projector.add_edge(edge, parts.lines);
  return parts;
}

void append_lines(const RenderScene& scene, const RenderOptions& options, ProjectedScene& projected) {
  std::vector<ViewPlane> planes;
  if (projected.view.perspective) planes.push_back({{0, 0, -1}, -projected.view.near_depth});
  for (const RenderLine& source : scene.lines) {
    ScreenLine line;
    line.color = source.color;
    line.half_width = 0.5f * source.width * static_cast<float>(options.samples);
    auto& out = projected.lines[static_cast<std::size_t>(source.overlay ? Layer::Overlay : Layer::Opaque)];
    ItemProjector::add_clipped_line(projected.view, planes, projected.view.to_view(source.ends[0]),
                                    projected.view.to_view(source.ends[1]), line, out);
  }
}

/// Appends all triangles of the two items of the overlap mark, without section.
void append_overlap(const RenderScene& scene, const RenderOptions& options, ProjectedScene& projected) {
  if (!scene.overlap) return;
  RenderScene whole;
  for (const std::size_t i : scene.overlap->items) whole.items.push_back(scene.items[i]);
  for (RenderItem& item : whole.items) {
    item.section = false;
    item.color.a = 1;
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    const ItemProjector projector(projected, whole, i, options);
    for (std::uint32_t f = 0; f < whole.items[i].mesh->mesh.faces.size(); ++f)
      projector.add_face(f, projected.triangles[static_cast<std::size_t>(Layer::Overlap)]);
  }
}

double scene_size(const RenderScene& scene) {
  Aabb box;
  for (const RenderItem& item : scene.items) {
    const Aabb b = bounds(item.mesh->mesh);
    if (b.empty()) continue;
    for (const Vec3& corner : corners_of(b)) box.extend(item.world_from_mesh * corner);
  }
  return std::max(diagonal(box), 1e-9);
}

}  // namespace

ProjectedScene project_scene(const RenderScene& scene, const Camera& camera, const RenderOptions& options) {
  ProjectedScene projected;
  projected.view = make_view(camera, options);
  projected.size = scene_size(scene);
  if (scene.section) {
    const SectionPlane& plane = *scene.section;
    projected.section =
        ViewPlane{projected.view.axes * plane.normal, plane.offset - dot(plane.normal, projected.view.eye)};
  }

  std::vector<ItemParts> parts(scene.items.size());
  options.executor.for_each_heavy(parts.size(), [&](std::size_t i) {
    parts[i] = project_item(projected, scene, static_cast<std::uint32_t>(i), options);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto layer = static_cast<std::size_t>(layer_of(scene.items[i]));
    auto& triangles = projected.triangles[layer];
    triangles.insert(triangles.end(), parts[i].triangles.begin(), parts[i].triangles.end());
    auto& lines = projected.lines[layer];
    lines.insert(lines.end(), parts[i].lines.begin(), parts[i].lines.end());
  }
  append_lines(scene, options, projected);
  append_overlap(scene, options, projected);
  return projected;
}

}  // namespace dismantle
