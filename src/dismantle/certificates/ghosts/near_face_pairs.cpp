// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/near_face_pairs.h"

#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"

namespace dismantle {

FacePairs near_face_pairs(const NearFacesRequest& request) {
  const SolidTree &own = *request.own, &other = *request.other;
  const TrianglePairSweep still(own, other, {}, {}, 0, request.tolerance);
  PairMotion motion = still.motion();
  motion.allowed = -request.reach;
  const CertificateFront pairs{own.tree, other.tree, own.revolution.get(), other.revolution.get(), {}};
  FacePairs faces;
  const TrianglePairTest take = [&](const TrianglePairCandidate& candidate) {
    faces.emplace_back(candidate.face_moving, candidate.face_fixed);
    return TrianglePairVerdict{};
  };
  PreparedSweep all = pairs.prepare_sweep(motion);
  all.max_tests = request.most;
  pairs.sweep_const(all, request.kernels, take);
  return faces;
}

}  // namespace dismantle
