// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/vrml_geometry.h"

#include "dismantle/formats/mesh/polygon.h"
#include "dismantle/math/quat.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dismantle {

namespace {

Vec3 vec3(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// The rotation by an angle about an axis; none without an axis.
std::optional<Mat3> rotation_of(const std::array<double, 4>& r) {
  const double size = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  if (!std::isfinite(size)) return std::nullopt;
  if (size == 0) return Mat3{};
  return mat3_from_quat(quat_about(Vec3{r[0], r[1], r[2]} / size, r[3]));
}

}  // namespace

std::optional<SceneTransform> vrml_transform(const VrmlTransform& fields) {
  const std::optional<Mat3> rotation = rotation_of(fields.rotation), oriented = rotation_of(fields.scale_orientation);
  if (!rotation || !oriented) return std::nullopt;
  const Vec3 s = vec3(fields.scale), center = vec3(fields.center);
  SceneTransform map;
  map.linear = *rotation * *oriented * Mat3{{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}} * transposed(*oriented);
  map.translation = vec3(fields.translation) + center - map.linear * center;
  return map;
}

std::optional<TriangleMesh> vrml_mesh(VrmlPolygons polygons, std::size_t triangle_limit) {
  TriangleMesh mesh;
  mesh.vertices = std::move(polygons.vertices);
  PolygonTriangulator triangulator;
  std::vector<std::uint32_t> corners;
  polygons.indices.push_back(-1);
  for (const double index : polygons.indices) {
    if (index >= 0) {
      if (!(index < static_cast<double>(mesh.vertices.size()))) return std::nullopt;
      corners.push_back(static_cast<std::uint32_t>(index));
      continue;
    }
    if (!polygons.is_counter_clockwise) std::reverse(corners.begin(), corners.end());
    if (corners.size() >= 3) triangulator.append(corners, mesh.vertices, mesh.faces);
    corners.clear();
    if (mesh.faces.size() > triangle_limit) return std::nullopt;
  }
  return mesh;
}

SceneMesh joined(const std::vector<const SceneMesh*>& parts) {
  SceneMesh whole;
  double largest = -1;
  for (const SceneMesh* part : parts) {
    const auto first = static_cast<std::uint32_t>(whole.mesh.vertices.size());
    const std::vector<Vec3>& vertices = part->mesh.vertices;
    whole.mesh.vertices.insert(whole.mesh.vertices.end(), vertices.begin(), vertices.end());
    double area = 0;
    for (std::size_t f = 0; f < part->mesh.faces.size(); ++f) {
      const Face& face = part->mesh.faces[f];
      whole.mesh.faces.push_back({{first + face.v[0], first + face.v[1], first + face.v[2]}});
      area += length(normal_unscaled(part->mesh.triangle(f)));
    }
    if (area <= largest) continue;
    largest = area;
    whole.color = part->color;
  }
  return whole;
}

TessellatedShape vrml_solid(std::string_view type, Vec3 size, double radius, double height) {
  if (type == "Box") return tessellate_box(size);
  TessellatedShape shape = type == "Sphere"     ? tessellate_sphere(radius)
                           : type == "Cylinder" ? tessellate_cylinder(radius, height)
                                                : tessellate_cone(radius, height);
  for (Vec3& p : shape.mesh.vertices) p = {p.x, p.z, -p.y};  // z, the axis, becomes y
  return shape;
}

}  // namespace dismantle
