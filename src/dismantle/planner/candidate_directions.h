// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/certificate_engine.h"
#include "dismantle/planner/shape_features.h"

#include <vector>

namespace dismantle {

/// A direction in which a component may well leave.
struct CandidateDirection {
  Vec3 direction;      ///< Unit.
  bool opens = false;  ///< It goes against none of the faces that the component touches, and straight away from most.
};

/// The directions in which a component may well leave: extreme rays of the cone that the faces it touches leave free,
/// their normals and cross products, the axes and plane faces of its own shape and of what it touches. Those that its
/// contacts allow come first. All are of the geometry: turned assemblies give turned directions. Unit, without repeats.
/// @param engine with the component in hand, in its assembled pose
/// @param features of every component
std::vector<CandidateDirection> candidate_directions(const Assembly& assembly, const CertificateEngine& engine,
                                                     ComponentId component, Span<const ShapeFeatures> features,
                                                     double tolerance);

}  // namespace dismantle
