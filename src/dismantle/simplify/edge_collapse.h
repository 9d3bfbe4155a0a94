// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"
#include "dismantle/simplify/quadric.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

namespace dismantle {

/// Collapses the edges of a mesh one after another, the one with the smallest quadric error first (QSlim: Garland and
/// Heckbert, "Surface simplification using quadric error metrics", 1997; each plane has weight 1, so that the error is
/// no less than the distance to any plane that was merged). An edge is collapsed onto one of its ends: vertices remain
/// vertices of the original, and flat faces remain exactly flat.
///   1. The topology is kept: an edge is collapsed only if its ends' common neighbours are those of its own triangles
///      (the link condition). A closed, consistently oriented mesh remains one.
///   2. No triangle becomes degenerate or turns its normal by more than about 80 degrees in one collapse.
///   3. Vertices of non-manifold edges do not move; borders of open meshes remain borders.
///   4. The collapses depend on the mesh alone.
class EdgeCollapse {
 public:
  /// Computes the quadrics and the cost of every edge.
  explicit EdgeCollapse(const TriangleMesh& mesh);

  /// Number of faces of the mesh in its current state.
  std::size_t face_count() const { return face_count_; }
  /// Largest quadric error of all collapses so far [mm].
  double error() const { return error_; }

  /// Performs the next collapse; false if none with an error of at most `error_limit` [mm] is possible.
  bool step(double error_limit = std::numeric_limits<double>::infinity());

  /// The mesh in its current state, without unused vertices.
  TriangleMesh mesh() const;

 private:
  struct Candidate {
    double cost;
    std::uint32_t from, to;
    std::uint32_t version_from, version_to;
  };
  struct CheapestFirst {
    bool operator()(const Candidate& a, const Candidate& b) const {
      if (a.cost != b.cost) return a.cost > b.cost;
      return a.from != b.from ? a.from > b.from : a.to > b.to;
    }
  };

  void add_face_quadrics();
  void add_edge_quadrics();
  void push(std::uint32_t from, std::uint32_t to);
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const;
  bool keeps_topology(std::uint32_t from, std::uint32_t to) const;
  bool keeps_shape(std::uint32_t from, std::uint32_t to) const;
  void collapse(std::uint32_t from, std::uint32_t to);
  Triangle triangle(const Face& face) const;

  std::vector<Vec3> original_;   // vertices as given
  std::vector<Vec3> positions_;  // about the box's centre, where quadrics lose the fewest digits
  std::vector<Face> faces_;
  std::vector<bool> face_alive_;
  std::vector<std::vector<std::uint32_t>> faces_of_;  // of each vertex
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> versions_;
  std::vector<bool> on_border_, locked_;
  std::priority_queue<Candidate, std::vector<Candidate>, CheapestFirst> queue_;
  std::size_t face_count_ = 0;
  double error_ = 0;
};

}  // namespace dismantle
