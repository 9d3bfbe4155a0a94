// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/stays_whole.h"

#include "dismantle/core/connected_sets.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

/// Largest number of faces, and of parts of them, that are divided.
constexpr int kMaxDivided = 5000;

/// A surface from which a solid is cut.
class CutSurface {
 public:
  CutSurface(Span<const Vec3> vertices, const SolidShape& cutter)
      : vertices_(vertices.begin(), vertices.end()),
        cutter_(cutter),
        side_(vertices.size()),
        before_(vertices.size()),
        after_(vertices.size()) {}

  void add(const Face& face) {
    for (const int k : {1, 2}) before_.join(face.v[0], face.v[k]);
    take(face);
  }

  /// Divides what was added, the longest parts first, until nothing across the cut is longer than `finest`.
  void divide(double finest) {
    for (int count = 0; !across_.empty(); ++count) {
      const Part part = across_.top();
      across_.pop();
      if (part.longest <= finest || count >= kMaxDivided) {
        connect_outside(part.face);
        continue;
      }
      const auto& v = part.face.v;
      const std::uint32_t m[3] = {middle(v[0], v[1]), middle(v[1], v[2]), middle(v[2], v[0])};
      for (const Face& one :
           {Face{{v[0], m[0], m[2]}}, Face{{m[0], v[1], m[1]}}, Face{{m[2], m[1], v[2]}}, Face{{m[0], m[1], m[2]}}})
        take(one);
    }
  }

  /// True if no connected part is in two.
  bool is_whole() {
    std::map<std::uint32_t, std::uint32_t> left;  // of a part before, a part after
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      if (side_[v] != Side::Outside) continue;
      const auto [known, fresh] = left.try_emplace(before_.set_of(v), after_.set_of(v));
      if (!fresh && known->second != after_.set_of(v)) return false;
    }
    return true;
  }

 private:
  enum class Side : std::uint8_t { Unknown, Outside, Inside };

  /// A face or a part of one that meets the surface of the cutter, as far as is known.
  struct Part {
    Face face;
    double longest;
    bool operator<(const Part& other) const { return longest < other.longest; }
  };

  Vec3 place(const Face& face, int k) const { return vertices_[face.v[k]]; }

  void take(const Face& face) {
    Aabb box;
    for (int k = 0; k < 3; ++k) box.extend(place(face, k));
    if (!overlaps(box, cutter_.surface().bounds())) return connect(face);
    const Vec3 center = (place(face, 0) + place(face, 1) + place(face, 2)) / 3;
    double radius = 0, longest = 0;
    for (int k = 0; k < 3; ++k) {
      radius = std::max(radius, length(place(face, k) - center));
      longest = std::max(longest, length(place(face, (k + 1) % 3) - place(face, k)));
    }
    last_ = cutter_.surface().distance(center, last_.face);
    if (last_.distance <= radius) {
      across_.push({face, longest});
    } else if (!cutter_.winding().inside(center)) {
      connect(face);
    }
  }

  /// Connects the vertices of a part that is outside.
  void connect(const Face& face) {
    for (const std::uint32_t v : face.v) side_[v] = Side::Outside;
    for (const int k : {1, 2}) after_.join(face.v[0], face.v[k]);
  }

  /// Connects those of its vertices that are outside.
  void connect_outside(const Face& face) {
    std::uint32_t first = 3;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = face.v[k];
      if (side_[v] == Side::Unknown) side_[v] = cutter_.winding().inside(vertices_[v]) ? Side::Inside : Side::Outside;
      if (side_[v] == Side::Inside) continue;
      if (first < 3) after_.join(face.v[first], v);
      first = k;
    }
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [known, fresh] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices_.size()));
    if (!fresh) return known->second;
    vertices_.push_back((vertices_[a] + vertices_[b]) / 2);
    side_.push_back(Side::Unknown);
    before_.grow(vertices_.size());
    after_.grow(vertices_.size());
    before_.join(a, known->second);
    return known->second;
  }

  std::vector<Vec3> vertices_;
  const SolidShape& cutter_;
  std::vector<Side> side_;
  ConnectedSets before_, after_;  // of vertices
  std::priority_queue<Part> across_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
  MeshDistance last_;
};

}  // namespace

bool stays_whole(Span<const Vec3> vertices, Span<const Face> faces, const SolidShape& cutter, double finest) {
  CutSurface surface(vertices, cutter);
  for (const Face& face : faces) surface.add(face);
  surface.divide(finest);
  return surface.is_whole();
}

}  // namespace dismantle
