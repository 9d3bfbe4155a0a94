// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/thin_places.h"

#include "dismantle/geometry/triangle.h"
#include "dismantle/narrowphase/distance_triangle_triangle.h"
#include "dismantle/surface/depth/nowhere_deeper.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

namespace {

/// Faces face each other from two sides of a wall where the cosine between their normals is less than this. Where two
/// faces meet at a blunter edge, what is within the limit of both is within about twice the limit of that edge.
constexpr double kOpposite = -0.55;

/// A face with its plane.
struct PlaneFace {
  Triangle triangle;
  Vec3 normal;  // outwards; null for a triangle without area

  /// True if a part of another face is below the plane.
  bool is_above(const Triangle& other) const {
    return std::any_of(other.corner, other.corner + 3, [&](Vec3 p) { return dot(normal, p - triangle[0]) < 0; });
  }
};

/// The faces of a surface, all turned over where it is inside out.
std::vector<PlaneFace> plane_faces(const SurfaceTree& surface) {
  const Vec3 origin = surface.bounds().center();
  double volume = 0;
  std::vector<PlaneFace> faces(surface.face_count());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = surface.triangle(f);
    const Vec3 normal = normal_unscaled(t);
    volume += dot(t[0] - origin, normal);
    faces[f] = {t, length_squared(normal) > 0 ? normalized(normal) : Vec3{}};
  }
  if (volume < 0)
    for (PlaneFace& face : faces) face.normal = -face.normal;
  return faces;
}

/// For each node of a tree, a box around the normals of the faces below it.
std::vector<Aabb> normal_boxes(const Bvh& bvh, const std::vector<PlaneFace>& faces) {
  std::vector<Aabb> boxes(bvh.node_count());
  for (NodeIndex node = 0; node < boxes.size(); ++node) {
    if (node < bvh.leaf_count()) {
      boxes[node].extend(faces[bvh.leaf_triangle[node]].normal);
      continue;
    }
    const BvhChildren children = bvh.children[node - bvh.leaf_count()];
    boxes[node] = boxes[children.left];
    boxes[node].extend(boxes[children.right]);
  }
  return boxes;
}

/// The least scalar product of a vector and a point of a box.
double least_product(Vec3 vector, const Aabb& box) {
  double least = 0;
  for (int i = 0; i < 3; ++i) least += std::min(vector[i] * box.lower[i], vector[i] * box.upper[i]);
  return least;
}

/// Finds faces that are opposite to others.
class OppositeFaces {
 public:
  OppositeFaces(const SurfaceTree& surface, double limit)
      : surface_(surface), limit_(limit), faces_(plane_faces(surface)), normals_(normal_boxes(surface.bvh(), faces_)) {}

  /// A face on the other side of a wall; nothing where the solid is thicker.
  std::optional<std::uint32_t> find(std::uint32_t f) const {
    const PlaneFace& face = faces_[f];
    Aabb box;
    for (const Vec3& p : face.triangle.corner) box.extend(surface_.axes() * p);
    box = inflated(box, 2 * limit_);
    const Bvh& bvh = surface_.bvh();
    std::vector<NodeIndex> waiting{bvh.root()};
    while (!waiting.empty()) {
      const NodeIndex node = waiting.back();
      waiting.pop_back();
      if (!overlaps(surface_.box(node), box) || least_product(face.normal, normals_[node]) >= kOpposite) continue;
      if (node >= bvh.leaf_count()) {
        const BvhChildren children = bvh.children[node - bvh.leaf_count()];
        waiting.push_back(children.left);
        waiting.push_back(children.right);
        continue;
      }
      const std::uint32_t g = bvh.leaf_triangle[node];
      const PlaneFace& other = faces_[g];
      if (face.is_above(other.triangle) && other.is_above(face.triangle) &&
          triangles_within(face.triangle, other.triangle, 2 * limit_))
        return g;
    }
    return std::nullopt;
  }

 private:
  const SurfaceTree& surface_;
  double limit_;
  std::vector<PlaneFace> faces_;
  std::vector<Aabb> normals_;  // of each node
};

/// For each face, whether it is at a thin place.
std::vector<bool> find_thin(const SurfaceTree& surface, double limit) {
  const OppositeFaces opposite(surface, limit);
  std::vector<bool> is_thin(surface.face_count());
  for (std::uint32_t f = 0; f < is_thin.size(); ++f) {
    if (is_thin[f]) continue;
    if (const std::optional<std::uint32_t> other = opposite.find(f)) is_thin[f] = is_thin[*other] = true;
  }
  return is_thin;
}

/// The faces that are at a thin place or that are not.
std::unique_ptr<const SurfaceTree> faces_of(const SurfaceTree& surface, const std::vector<bool>& is_thin, bool thin) {
  TriangleMesh faces;
  for (std::uint32_t f = 0; f < is_thin.size(); ++f) {
    if (is_thin[f] != thin) continue;
    const auto first = static_cast<std::uint32_t>(faces.vertices.size());
    const Triangle& t = surface.triangle(f);
    faces.vertices.insert(faces.vertices.end(), t.corner, t.corner + 3);
    faces.faces.push_back({{first, first + 1, first + 2}});
  }
  return std::make_unique<const SurfaceTree>(faces);
}

}  // namespace

ThinPlaces::ThinPlaces(const SolidShape& solid, double limit) {
  is_everywhere_ = is_nowhere_deeper(solid, limit);
  if (is_everywhere_) return;
  const SurfaceTree& surface = solid.surface();
  const std::vector<bool> is_thin = find_thin(surface, limit);
  is_none_ = std::find(is_thin.begin(), is_thin.end(), true) == is_thin.end();
  if (is_none_ || std::find(is_thin.begin(), is_thin.end(), false) == is_thin.end()) return;
  thin_ = faces_of(surface, is_thin, true);
  thick_ = faces_of(surface, is_thin, false);
}

}  // namespace dismantle
