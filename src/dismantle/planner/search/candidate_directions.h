// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/shape_features.h"

#include <map>
#include <set>
#include <vector>

namespace dismantle {

/// The faces that bound a component's motion, as unit normals towards it; weights are areas [mm^2].
struct ContactNormals {
  std::vector<WeightedDirection> facing;                            ///< From faces that look at each other.
  std::vector<WeightedDirection> other;                             ///< From edges and corners.
  std::map<ComponentId, std::vector<WeightedDirection>> facing_of;  ///< The first, by the neighbour that they are of.
  std::set<ComponentId> neighbours;
};

/// Of the component in hand, in its assembled pose.
/// @param radius of the component [mm]
ContactNormals contact_normals(const Assembly& assembly, const CertificateEngine& engine, double radius,
                               double tolerance);

/// The neighbours with faces that a unit direction clearly goes against: as a rule they block it.
std::vector<ComponentId> neighbours_against(const ContactNormals& contacts, const Vec3& direction);

/// A direction in which a component may well leave.
struct CandidateDirection {
  Vec3 direction;      ///< Unit.
  bool opens = false;  ///< It goes against none of the faces that the component touches, and straight away from most.
};

/// The directions in which a component may well leave: extreme rays of the cone that the faces it touches leave free,
/// their normals and cross products, the axes and plane faces of its own shape and of what it touches. Those that its
/// contacts allow come first. All are of the geometry: turned assemblies give turned directions. Unit, without repeats.
/// @param features of every component
std::vector<CandidateDirection> candidate_directions(ComponentId component, const ContactNormals& contacts,
                                                     Span<const ShapeFeatures> features);

}  // namespace dismantle
