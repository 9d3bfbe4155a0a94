// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/planned_assembly.h"

#include <map>
#include <set>
#include <vector>

namespace dismantle {

/// The contacts that constrain a component's motion, as unit normals towards it; weights are areas [mm^2].
struct ContactNormals {
  std::vector<WeightedDirection> facing;                            ///< Of face contacts: faces that oppose each other.
  std::vector<WeightedDirection> other;                             ///< Of edge and corner contacts.
  std::map<ComponentId, std::vector<WeightedDirection>> facing_of;  ///< `facing` by neighbour.
  std::set<ComponentId> neighbours;                                 ///< All components in contact.
};

/// The contact normals of a component. May be called by many threads at the same time.
/// @param engine with all components in their assembled poses
ContactNormals contact_normals(const PlannedAssembly& planned, const CertificateEngine& engine, ComponentId component);

/// The neighbours with contact faces that clearly oppose a unit direction; they usually block it.
std::vector<ComponentId> neighbours_against(const ContactNormals& contacts, const Vec3& direction);

/// A direction along which a component can probably be removed.
struct CandidateDirection {
  Vec3 direction;      ///< Unit.
  bool opens = false;  ///< It opposes none of the contact faces and separates most of them.
};

/// The candidate directions of a component: extreme rays of the cone of directions that its contacts allow, their
/// normals and cross products, axes and plane faces of its own shape and of its neighbours. Directions that the
/// contacts allow come first. They follow the geometry: a rotated assembly gives rotated directions. Unit vectors, no
/// repeats.
/// @param features of every component
std::vector<CandidateDirection> candidate_directions(ComponentId component, const ContactNormals& contacts,
                                                     Span<const ShapeFeatures> features);

}  // namespace dismantle
