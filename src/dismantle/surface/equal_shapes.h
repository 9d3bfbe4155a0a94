// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

#include <vector>

namespace dismantle {

/// The first component of the shape of each: components have equal shapes if they share a mesh, or a rigid motion takes
/// the mesh of one onto that of the other (congruence()): not mirrored, with vertices and faces in any order, rounded
/// by the file or not. In CAD assemblies, copies that were tessellated with other vertices are found, too
/// (surface_congruence(), within twice the deflection). Colours do not matter. Components are compared with those whose
/// invariants agree only. Shape [component_count]; first_of_shape(a)[c] == c for the first of each shape.
std::vector<ComponentId> first_of_shape(const Assembly& assembly);

/// Number of different shapes. @param firsts what first_of_shape() returns
std::size_t shape_count(const std::vector<ComponentId>& firsts);

}  // namespace dismantle
