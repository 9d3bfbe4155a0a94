// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/surface/solid_shape.h"
#include "dismantle/surface/solid_tree.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace dismantle {

/// One of two components that overlap in the assembled state.
struct OverlapSide {
  const SolidTree* tree = nullptr;                ///< Never null.
  std::function<const SolidShape&()> make_shape;  ///< The same component; called where it is needed, often.

  /// The same component.
  const SolidShape& shape() const { return make_shape(); }
  /// True if it is a sheet, in which nothing is inside.
  bool is_sheet() const { return !tree->has_outside && !tree->inside_out; }
};

/// The edges of a component's surface, in which vertices at one position are one.
struct SurfaceEdges {
  /// Stands for a side of a face without length.
  static constexpr std::uint32_t kNoEdge = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint32_t> first;       ///< As first_at_position() gives it.
  std::vector<std::uint32_t> edge;        ///< At each side of each face, or kNoEdge; shape [3 face_count].
  std::vector<std::uint32_t> first_face;  ///< The lowest face at each edge.

  /// The edges of a component.
  explicit SurfaceEdges(const SolidTree& tree);
};

/// Points of one component's surface, and where they are in another component: the middles of faces, and the ends and
/// middles of the parts of edges in the other one's box. Each is looked up when it is first asked for, and once, as
/// most of them are points of several faces.
class OverlapSamples {
 public:
  /// A point of the surface.
  struct Sample {
    Vec3 point;            ///< [mm, assembled]
    std::size_t slot = 0;  ///< Its number.
  };

  /// @param surface, edges, solid outlive this
  /// @param depth distances above this one are of no account [mm]
  OverlapSamples(const SolidTree& surface, const SurfaceEdges& edges, const OverlapSide& solid, double depth);

  /// Calls visit(face, sample) for the points of all faces.
  template <class Visit>
  void for_each(const Visit& visit) const;
  /// The distance from the surface of the other component; if it is above the depth, some distance above it.
  MeshDistance nearest(const Sample& sample);
  /// True if the point is inside the other component.
  bool inside(const Sample& sample);

 private:
  static constexpr std::size_t kNoSlot = std::numeric_limits<std::size_t>::max();
  enum class Place : std::uint8_t { Unknown, Outside, Inside };
  struct Known {
    double distance = -1;  // below 0: not known
    std::uint32_t face = 0;
    Place place = Place::Unknown;
  };
  std::pair<double, double> part_in_box(Vec3 from, Vec3 along) const;

  const SolidTree& surface_;
  const SurfaceEdges& edges_;
  const SolidShape& solid_;
  double depth_;
  std::vector<Known> known_;
};

template <class Visit>
void OverlapSamples::for_each(const Visit& visit) const {
  const std::size_t face_count = surface_.faces.size(), vertex_count = surface_.vertices.size();
  for (std::uint32_t f = 0; f < face_count; ++f) {
    const Triangle t = surface_.triangle(f);
    visit(f, Sample{(t[0] + t[1] + t[2]) / 3, f});
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t edge = edges_.edge[3 * f + i];
      if (edge == SurfaceEdges::kNoEdge) continue;
      // In the direction that all faces at the edge agree about.
      const auto [low, high] =
          std::minmax(edges_.first[surface_.faces[f].v[i]], edges_.first[surface_.faces[f].v[(i + 1) % 3]]);
      const Vec3 from = surface_.vertices[low], along = surface_.vertices[high] - from;
      const auto [begin, end] = part_in_box(from, along);
      if (begin > end) continue;
      visit(f, begin == 0 ? Sample{from, face_count + low} : Sample{from + begin * along, kNoSlot});
      visit(f, Sample{from + (begin + end) / 2 * along, face_count + vertex_count + edge});
      visit(f, end == 1 ? Sample{surface_.vertices[high], face_count + high} : Sample{from + end * along, kNoSlot});
    }
  }
}

}  // namespace dismantle
