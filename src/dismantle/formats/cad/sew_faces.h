// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/cad/product_tree.h"

#include <TopoDS_Shape.hxx>

namespace dismantle {

/// A shape with its faces outside solids sewn together where their edges are within the tolerance of each other, unit
/// of the shape: shells where they meet, and solids with the material inside where a shell is closed. Solids stay as
/// they are. The colours of faces that change are set for those that they become. The shape itself if there is no such
/// face.
TopoDS_Shape sew_loose_faces(const TopoDS_Shape& shape, double tolerance, CadProduct& colors);

}  // namespace dismantle
