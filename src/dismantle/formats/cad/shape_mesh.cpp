// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/shape_mesh.h"

#include "dismantle/core/connected_sets.h"

#include <BRep_Tool.hxx>
#include <NCollection_DataMap.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <utility>
#include <vector>

namespace dismantle {

namespace {

Vec3 node_position(const Poly_Triangulation& triangulation, int node, const TopLoc_Location& location) {
  gp_Pnt p = triangulation.Node(node);
  if (!location.IsIdentity()) p.Transform(location.Transformation());
  return {p.X(), p.Y(), p.Z()};
}

/// Collects face nodes and merges those that are the same point of the shape: nodes of different faces on one edge.
class NodeWelder {
 public:
  /// Adds the nodes and triangles of one face.
  void add_face(const TopoDS_Face& face) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, location);
    if (triangulation.IsNull()) return;

    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int i = 1; i <= triangulation->NbNodes(); ++i)
      mesh_.vertices.push_back(node_position(*triangulation, i, location));
    same_.grow(mesh_.vertices.size());

    for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      triangulation->Triangle(i).Get(a, b, c);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
      mesh_.faces.push_back({{node(first, a), node(first, b), node(first, c)}});
    }

    // In the face's forward orientation a seam edge occurs once in each direction, and so gives both of its polygons.
    for (TopExp_Explorer edges(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      const Handle(Poly_PolygonOnTriangulation) polygon =
          BRep_Tool::PolygonOnTriangulation(edge, triangulation, location);
      if (!polygon.IsNull()) weld_edge(edge, *polygon, first);
    }
  }

  /// The mesh, without merged vertices.
  TriangleMesh welded() && {
    std::vector<std::uint32_t> kept_index(mesh_.vertices.size());
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (same_.set_of(v) != v) continue;
      mesh_.vertices[kept] = mesh_.vertices[v];
      kept_index[v] = kept++;
    }
    mesh_.vertices.resize(kept);
    for (Face& face : mesh_.faces)
      for (std::uint32_t& v : face.v) v = kept_index[same_.set_of(v)];
    return std::move(mesh_);
  }

 private:
  static std::uint32_t node(std::uint32_t first, int one_based) {
    return first + static_cast<std::uint32_t>(one_based - 1);
  }

  void weld_edge(const TopoDS_Edge& edge, const Poly_PolygonOnTriangulation& polygon, std::uint32_t first) {
    std::vector<std::uint32_t> nodes;
    for (int i = 1; i <= polygon.NbNodes(); ++i) nodes.push_back(node(first, polygon.Node(i)));

    TopoDS_Vertex start, end;
    TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), start, end);
    if (!start.IsNull()) weld(nodes.front(), at_vertex(start, nodes.front()));
    if (!end.IsNull()) weld(nodes.back(), at_vertex(end, nodes.back()));
    if (BRep_Tool::Degenerated(edge))  // a pole: the whole edge is one point
      for (const std::uint32_t n : nodes) weld(nodes.front(), n);

    const std::vector<std::uint32_t>* known = edge_nodes_.Seek(edge);
    if (known == nullptr) {
      edge_nodes_.Bind(edge, nodes);
    } else if (known->size() == nodes.size()) {
      for (std::size_t i = 0; i < nodes.size(); ++i) weld((*known)[i], nodes[i]);
    }
  }

  std::uint32_t at_vertex(const TopoDS_Vertex& vertex, std::uint32_t node_there) {
    if (const std::uint32_t* known = vertex_nodes_.Seek(vertex)) return *known;
    vertex_nodes_.Bind(vertex, node_there);
    return node_there;
  }

  /// The earlier node represents both.
  void weld(std::uint32_t a, std::uint32_t b) {
    const auto [first, second] = std::minmax({same_.set_of(a), same_.set_of(b)});
    same_.join(first, second);
  }

  TriangleMesh mesh_;
  ConnectedSets same_;  // of vertices of mesh_
  NCollection_DataMap<TopoDS_Shape, std::vector<std::uint32_t>, TopTools_ShapeMapHasher> edge_nodes_;
  NCollection_DataMap<TopoDS_Shape, std::uint32_t, TopTools_ShapeMapHasher> vertex_nodes_;
};

}  // namespace

TriangleMesh mesh_from_shape(const TopoDS_Shape& shape) {
  NodeWelder welder;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    welder.add_face(TopoDS::Face(faces.Current()));
  return std::move(welder).welded();
}

double triangulated_area(const TopoDS_Shape& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(TopoDS::Face(face), location);
  if (triangulation.IsNull()) return 0;
  double twice_area = 0;
  for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    triangulation->Triangle(i).Get(a, b, c);
    const Vec3 p = node_position(*triangulation, a, {});
    twice_area += length(cross(node_position(*triangulation, b, {}) - p, node_position(*triangulation, c, {}) - p));
  }
  return twice_area / 2;
}

}  // namespace dismantle
