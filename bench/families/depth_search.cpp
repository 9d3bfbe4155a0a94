// SPDX-License-Identifier: Apache-2.0
#include "bench/families/depth_search.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

namespace dismantle::families {

namespace {

/// Depths are found to within this share.
constexpr double kRelativeGap = 0.01;
/// Distances that are known are looked for up to this much further, because of rounding [mm].
constexpr double kPlacement = 1e-11;
/// Surfaces that are not found apart with so many pieces are not.
constexpr std::size_t kMaxPieces = 300000;

struct Piece {
  double bound = 0;
  Triangle corners;  // in the frame of the other surface
  bool of_first = true;
  bool inside = false;     // as a whole
  std::uint32_t face = 0;  // of the other surface, near
  friend bool operator<(const Piece& a, const Piece& b) { return a.bound < b.bound; }
};

Vec3 middle_of(const Triangle& t) {
  return (t[0] + t[1] + t[2]) / 3;
}

double radius_of(const Triangle& t, Vec3 center) {
  return std::max({length(t[0] - center), length(t[1] - center), length(t[2] - center)});
}

/// The two halves of a triangle across its longest edge.
void halve(const Triangle& t, Triangle& first, Triangle& second) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (length(t[(i + 1) % 3] - t[i]) > length(t[(k + 1) % 3] - t[k])) k = i;
  const Vec3 middle = (t[k] + t[(k + 1) % 3]) / 2;
  first = second = t;
  first[(k + 1) % 3] = middle;
  second[k] = middle;
}

class Search {
 public:
  Search(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first,
         const DepthEffort& effort)
      : own_{&first, &second}, to_other_{second_from_first, inverse(second_from_first)}, effort_(effort) {}

  FoundDepth run() {
    std::size_t pieces = effort_.pieces;
    for (const bool of_first : {true, false})
      if (other(of_first).solid())
        for (std::size_t f = 0; f < own(of_first).mesh().faces.size(); ++f) {
          Triangle t = own(of_first).mesh().triangle(f);
          for (Vec3& p : t.corner) p = to_other_[of_first ? 0 : 1] * p;
          add({1e300, t, of_first, false, 0});
        }
    for (; !open_.empty() && open_.top().bound > goal(); --pieces) {
      if (pieces == 0) {
        found_.cut = true;
        break;
      }
      const Piece piece = open_.top();
      open_.pop();
      Piece half[2] = {piece, piece};
      halve(piece.corners, half[0].corners, half[1].corners);
      for (const Piece& h : half) add(h);
    }
    found_.bound = std::max(found_.attained, dropped_);
    if (!open_.empty()) found_.bound = std::max(found_.bound, open_.top().bound);
    return found_;
  }

 private:
  double goal() const {
    return std::max(effort_.floor, found_.attained + std::max(effort_.gap, kRelativeGap * found_.attained));
  }
  const OracleMesh& own(bool of_first) const { return *own_[of_first ? 0 : 1]; }
  const OracleMesh& other(bool of_first) const { return *own_[of_first ? 1 : 0]; }

  void add(Piece piece) {
    const OracleMesh& surface = other(piece.of_first);
    Aabb box;
    for (const Vec3& p : piece.corners.corner) box.extend(p);
    if (!overlaps(box, surface.bounds())) return;
    const Vec3 middle = middle_of(piece.corners);
    const double radius = radius_of(piece.corners, middle);
    const NearestFace near = surface.nearest(middle, surface.distance_to(piece.face, middle) * (1 + 1e-6) + kPlacement);
    piece.face = near.face;
    double by_face = 0;
    for (const Vec3& p : piece.corners.corner) by_face = std::max(by_face, surface.distance_to(near.face, p));
    piece.bound = std::min({piece.bound, near.distance + radius, by_face});
    if (piece.bound <= goal()) {
      dropped_ = std::max(dropped_, piece.bound);
      return;
    }
    if (!piece.inside && near.distance > radius) {
      if (!surface.inside(middle, near)) return;
      piece.inside = true;
    }
    attain(piece, middle, near);
    for (const Vec3& p : piece.corners.corner) {
      const double most = surface.distance_to(near.face, p);
      if (most > std::max(found_.attained, effort_.floor))
        attain(piece, p, surface.nearest(p, most * (1 + 1e-6) + kPlacement));
    }
    open_.push(piece);
  }

  void attain(const Piece& piece, Vec3 point, const NearestFace& near) {
    if (near.distance <= std::max(found_.attained, effort_.floor)) return;
    if (!piece.inside && !other(piece.of_first).inside(point, near)) return;
    found_.attained = near.distance;
    found_.at = to_other_[piece.of_first ? 1 : 0] * point;
    found_.of_first = piece.of_first;
  }

  const OracleMesh* own_[2];
  RigidTransform to_other_[2];
  DepthEffort effort_;
  double dropped_ = 0;
  std::priority_queue<Piece> open_;
  FoundDepth found_;
};

}  // namespace

FoundDepth search_depth(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first,
                        const DepthEffort& effort) {
  return Search(first, second, second_from_first, effort).run();
}

bool apart(const OracleMesh& first, const OracleMesh& second, const RigidTransform& second_from_first, double gap) {
  std::vector<Triangle> open;
  for (std::size_t f = 0; f < first.mesh().faces.size(); ++f) {
    Triangle t = first.mesh().triangle(f);
    for (Vec3& p : t.corner) p = second_from_first * p;
    open.push_back(t);
  }
  for (const Vec3& p : first.mesh().vertices)
    if (second.nearest(second_from_first * p, gap).distance < gap) return false;
  for (std::size_t pieces = 0; !open.empty(); ++pieces) {
    if (pieces == kMaxPieces + first.mesh().faces.size()) return false;
    const Triangle t = open.back();
    open.pop_back();
    const Vec3 middle = middle_of(t);
    const double reach = radius_of(t, middle) + gap, distance = second.nearest(middle, reach).distance;
    if (distance >= reach) continue;
    if (distance < gap) return false;
    Triangle halves[2];
    halve(t, halves[0], halves[1]);
    open.push_back(halves[0]);
    open.push_back(halves[1]);
  }
  const RigidTransform back = inverse(second_from_first);
  return !second.inside(second_from_first * first.mesh().vertices.front()) &&
         !first.inside(back * second.mesh().vertices.front());
}

}  // namespace dismantle::families
