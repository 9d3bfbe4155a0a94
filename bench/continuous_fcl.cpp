// SPDX-License-Identifier: Apache-2.0
#include "bench/continuous_fcl.h"

#include "bench/fcl_models.h"

#include <fcl/narrowphase/continuous_collision.h>

namespace dismantle {

FirstTouch continuous_fcl(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& start, const Pose& end,
                          FclSolver solver) {
  const auto standing = make_fcl_model(fixed), going = make_fcl_model(moving);
  const fcl::Transform3d still = fcl::Transform3d::Identity();
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_SCREW;
  request.ccd_solver_type = solver == FclSolver::Naive ? fcl::CCDC_NAIVE : fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(going.get(), make_fcl_transform(start), make_fcl_transform(end), standing.get(), still, still,
                         request, result);
  return {!result.is_collide, result.is_collide ? result.time_of_contact : 1};
}

}  // namespace dismantle
