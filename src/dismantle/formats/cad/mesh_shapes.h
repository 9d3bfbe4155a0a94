// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <TopoDS_Shape.hxx>
#include <vector>

namespace dismantle {

/// Triangulates all faces of some shapes at once, in parallel; the triangles are kept in the shapes. OpenCASCADE 7.6
/// gives up on some conical faces, such as chamfers around holes: they are triangulated as surfaces of revolution,
/// which are the same points.
/// @param deflection largest distance of a triangle from its surface [unit of the shapes] @param angle largest turn of
/// the normal from facet to facet [rad]
void mesh_shapes(const std::vector<TopoDS_Shape>& shapes, double deflection, double angle,
                 const ProgressCallback& progress);

}  // namespace dismantle
