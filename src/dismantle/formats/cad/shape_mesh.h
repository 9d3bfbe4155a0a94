// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle_mesh.h"

class TopoDS_Shape;

namespace dismantle {

/// The triangles that BRepMesh left on the faces of a shape, in one mesh, normals out of the faces' material side
/// [unit of the shape; the shape's location applied]. Nodes on an edge that faces share, and at its vertices, become
/// one vertex each, so that a solid whose faces share their edges gives a closed mesh. Faces without triangles are
/// left out.
TriangleMesh mesh_from_shape(const TopoDS_Shape& shape);

/// The area of the triangles on a face [square units of the shape].
double triangulated_area(const TopoDS_Shape& face);

}  // namespace dismantle
