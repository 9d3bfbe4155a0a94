// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/solid/thin_walls.h"

#include "dismantle/audit/solid/surface_crossing.h"
#include "dismantle/audit/triangle_axes.h"
#include "dismantle/core/connected_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace dismantle::audit {

namespace {

/// Normals are opposite where their product is less than this.
constexpr double kOpposite = -0.55;
/// Borders of two parts are the same where they are closer to each other than this many times the finest.
constexpr double kJoined = 1.5;
/// Largest number of faces that a surface is divided into.
constexpr std::size_t kMaxFaces = 100'000;

/// True if the way along `normal` from a point on a face meets a face on the other side of a wall.
bool is_thin_at(const SolidBody& solid, Vec3 point, Vec3 inwards, double thickness) {
  const AuditBody& surface = solid.surface();
  const auto crossed = [&](double to) {
    const std::optional<int> number =
        surface.crossings_between(point + 1e-6 * thickness * inwards, point + to * inwards);
    return number && *number != 0;
  };
  double without = 0, with = thickness;
  if (!crossed(with)) return false;
  while (with - without > 1e-3 * thickness) {
    const double middle = (without + with) / 2;
    (crossed(middle) ? with : without) = middle;
  }
  const std::uint32_t face = surface.closest(point + with * inwards).face;
  return dot(solid.orientation() * unit_normal(surface.triangle(face)), -inwards) < kOpposite;
}

/// The part of the surface of a solid that is outside of another one, or inside.
class SurfacePart {
 public:
  /// @param other_from_body the position of a point in the frame of `other`, less that in the frame of `body`
  SurfacePart(const AuditBody& body, const SolidBody& other, Vec3 other_from_body, bool inside, double finest)
      : other_(other),
        other_from_body_(other_from_body),
        inside_(inside),
        finest_(finest),
        pieces_(body.vertex_count()) {
    for (std::uint32_t v = 0; v < body.vertex_count(); ++v) vertices_.push_back(body.vertex(v));
    for (std::uint32_t f = 0; f < body.face_count(); ++f) {
      const Face& face = body.face(f);
      for (const int k : {1, 2}) pieces_.join(face.v[0], face.v[k]);
      add(face);
    }
    while (divide() && faces_.size() < kMaxFaces) continue;
    find_parts();
  }

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(vertices_.size()); }
  Vec3 vertex(std::uint32_t v) const { return vertices_[v]; }
  /// True for a vertex of the part.
  bool has(std::uint32_t v) const { return use_[v] != Use::None; }
  /// True for a vertex of the part that is at its border, or where the surfaces touch.
  bool at_border(std::uint32_t v) const { return use_[v] == Use::Border; }
  /// The sets of vertices that are connected along the part.
  std::uint32_t set_of(std::uint32_t v) { return parts_.set_of(v); }
  /// The connected piece of the whole surface.
  std::uint32_t piece_of(std::uint32_t v) { return pieces_.set_of(v); }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  /// Where a face is with regard to the other solid. Across: it may meet its surface. Touching: all of it is closer to
  /// it than half of the finest.
  enum class Place : std::uint8_t { Outside, Inside, Across, Touching };
  enum class Use : std::uint8_t { None, Within, Border };
  struct PlacedFace {
    Face face;
    Place place;
  };

  static Edge edge_of(const Face& face, int k) { return std::minmax(face.v[k], face.v[(k + 1) % 3]); }

  void add(const Face& face) { faces_.push_back({face, place_of(face)}); }

  Place place_of(const Face& face) {
    Triangle here;
    for (int k = 0; k < 3; ++k) here[k] = vertices_[face.v[k]] + other_from_body_;
    const std::optional<std::uint32_t> met = face_met_by(here);
    if (!met) return other_.inside((here[0] + here[1] + here[2]) / 3.0, last_) ? Place::Inside : Place::Outside;
    const Triangle t = other_.surface().triangle(*met);
    for (int k = 0; k < 3; ++k)
      if (distance_to_triangle(t, here[k]) > finest_ / 2) return Place::Across;
    return Place::Touching;
  }

  /// A face of the other solid that meets a triangle in its frame.
  std::optional<std::uint32_t> face_met_by(const Triangle& triangle) {
    const AuditBody& surface = other_.surface();
    const auto meets = [&](std::uint32_t face) { return widest_gap(triangle, surface.triangle(face), 0).gap <= 0; };
    if (meets(met_)) return met_;
    const Vec3 lower = min(min(triangle[0], triangle[1]), triangle[2]);
    const Vec3 upper = max(max(triangle[0], triangle[1]), triangle[2]);
    const Vec3 center = (lower + upper) / 2.0, half = max(upper - center, center - lower);
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      const BoxNode& node = surface.node(i);
      const Vec3 offset = node.center - center, apart = max(offset, -offset) - (half + node.half);
      if (apart.x > 0 || apart.y > 0 || apart.z > 0) continue;
      if (!node.leaf()) {
        stack.push_back(node.right);
        stack.push_back(i + 1);
      } else if (meets(node.face)) {
        met_ = node.face;
        return met_;
      }
    }
    return std::nullopt;
  }

  /// Halves the edges of faces across the other surface that are longer than the finest. @return false for none
  bool divide() {
    std::map<Edge, std::uint32_t> middles;
    for (const PlacedFace& one : faces_)
      for (int k = 0; k < 3 && one.place == Place::Across; ++k) {
        const Edge edge = edge_of(one.face, k);
        if (length(vertices_[edge.first] - vertices_[edge.second]) > finest_) middles.try_emplace(edge, 0);
      }
    for (auto& [edge, middle] : middles) {
      middle = vertex_count();
      vertices_.push_back((vertices_[edge.first] + vertices_[edge.second]) / 2.0);
      pieces_.grow(vertices_.size());
      pieces_.join(edge.first, middle);
    }
    std::vector<PlacedFace> before;
    before.swap(faces_);
    for (const PlacedFace& one : before) add_divided(one, middles);
    return !middles.empty();
  }

  /// Adds a face in two to four faces, by the edges that have a middle.
  void add_divided(const PlacedFace& one, const std::map<Edge, std::uint32_t>& middles) {
    const auto& v = one.face.v;
    std::uint32_t m[3] = {0, 0, 0};
    bool is_halved[3];
    for (int k = 0; k < 3; ++k) {
      const auto found = middles.find(edge_of(one.face, k));
      is_halved[k] = found != middles.end();
      if (is_halved[k]) m[k] = found->second;
    }
    const int count = is_halved[0] + is_halved[1] + is_halved[2];
    if (count == 0) {
      faces_.push_back(one);
    } else if (count == 1) {
      const int a = is_halved[0] ? 0 : is_halved[1] ? 1 : 2, b = (a + 1) % 3, c = (a + 2) % 3;
      add({{v[a], m[a], v[c]}});
      add({{m[a], v[b], v[c]}});
    } else if (count == 2) {
      const int a = !is_halved[0] ? 0 : !is_halved[1] ? 1 : 2, b = (a + 1) % 3, c = (a + 2) % 3;
      add({{v[a], v[b], m[b]}});
      add({{v[a], m[b], m[c]}});
      add({{m[c], m[b], v[c]}});
    } else {
      add({{v[0], m[0], m[2]}});
      add({{m[0], v[1], m[1]}});
      add({{m[2], m[1], v[2]}});
      add({{m[0], m[1], m[2]}});
    }
  }

  void find_parts() {
    use_.assign(vertices_.size(), Use::None);
    parts_.grow(vertices_.size());
    for (const PlacedFace& one : faces_) {
      if (one.place == (inside_ ? Place::Outside : Place::Inside)) continue;
      for (const std::uint32_t v : one.face.v) {
        if (one.place == Place::Across && other_.inside(vertices_[v] + other_from_body_, last_) != inside_) continue;
        const bool is_border = one.place == Place::Across || one.place == Place::Touching;
        use_[v] = std::max(use_[v], is_border ? Use::Border : Use::Within);
      }
    }
    for (const PlacedFace& one : faces_)
      for (int k = 0; k < 3 && one.place != (inside_ ? Place::Outside : Place::Inside); ++k) {
        const auto [a, b] = edge_of(one.face, k);
        if (has(a) && has(b)) parts_.join(a, b);
      }
  }

  const SolidBody& other_;
  Vec3 other_from_body_;
  bool inside_;
  double finest_;
  std::vector<Vec3> vertices_;  // in the body's frame
  std::vector<PlacedFace> faces_;
  ConnectedSets pieces_, parts_;  // of vertices
  std::vector<Use> use_;          // of vertices
  std::uint32_t met_ = 0;
  SolidBody::LastPoint last_;
};

/// The vertices at the border of a part, by cells of a grid.
class BorderGrid {
 public:
  BorderGrid(const SurfacePart& part, double size) : part_(part), size_(size) {
    for (std::uint32_t v = 0; v < part.vertex_count(); ++v)
      if (part.at_border(v)) cells_[cell_of(part.vertex(v))].push_back(v);
  }

  /// Calls visit(v) for the vertices that are no further from a point than the size of a cell.
  template <class Visit>
  void visit_near(Vec3 point, const Visit& visit) const {
    const Cell cell = cell_of(point);
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == cells_.end()) continue;
      for (const std::uint32_t v : found->second)
        if (length(part_.vertex(v) - point) <= size_) visit(v);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(Vec3 point) const {
    Cell cell{};
    for (int i = 0; i < 3; ++i)
      cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(point[i] / size_));
    return cell;
  }

  const SurfacePart& part_;
  double size_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// True if the vertices of each piece of a surface that are left are in one of the sets, to which its parts belong.
bool are_connected(SurfacePart& left, ConnectedSets& sets) {
  std::map<std::uint32_t, std::uint32_t> of_piece;
  for (std::uint32_t v = 0; v < left.vertex_count(); ++v) {
    if (!left.has(v)) continue;
    const std::uint32_t set = sets.set_of(left.set_of(v));
    const auto [known, fresh] = of_piece.try_emplace(left.piece_of(v), set);
    if (!fresh && known->second != set) return false;
  }
  return true;
}

}  // namespace

bool has_thin_wall(const SolidBody& solid, double thickness, double spacing) {
  if (!solid.solid()) return false;
  bool thin = false;
  visit_points_of_faces(solid.surface(), spacing, [&](std::uint32_t face, Vec3 point) {
    thin =
        thin || is_thin_at(solid, point, -solid.orientation() * unit_normal(solid.surface().triangle(face)), thickness);
  });
  return thin;
}

bool stays_in_one_piece(const SolidBody& solid, const SolidBody& cutter, double finest) {
  const Vec3 cutter_from_solid = solid.surface().center() - cutter.surface().center();
  SurfacePart left(solid.surface(), cutter, cutter_from_solid, false, finest);
  ConnectedSets sets(left.vertex_count());
  if (are_connected(left, sets)) return true;
  SurfacePart cut(cutter.surface(), solid, -1.0 * cutter_from_solid, true, finest);
  sets.grow(left.vertex_count() + cut.vertex_count());
  const BorderGrid grid(left, kJoined * finest);
  for (std::uint32_t v = 0; v < cut.vertex_count(); ++v)
    if (cut.at_border(v))
      grid.visit_near(cut.vertex(v) - cutter_from_solid,
                      [&](std::uint32_t near) { sets.join(left.set_of(near), left.vertex_count() + cut.set_of(v)); });
  return are_connected(left, sets);
}

template <class Key, class Find>
bool KnownWalls::find(std::map<Key, bool>& known, const Key& key, const Find& find) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto entry = known.find(key); entry != known.end()) return entry->second;
  }
  const bool found = find();
  const std::lock_guard lock(mutex_);
  known.emplace(key, found);
  return found;
}

bool KnownWalls::has_thin_wall(const SolidBody& solid, double thickness, double spacing) {
  return find(walls_, WallKey{&solid, thickness, spacing},
              [&] { return audit::has_thin_wall(solid, thickness, spacing); });
}

bool KnownWalls::has_hole(const SolidBody& solid, const SolidBody& other, double finest) {
  return find(holes_, HoleKey{&solid, &other, finest}, [&] { return stays_in_one_piece(solid, other, finest); });
}

}  // namespace dismantle::audit
