// SPDX-License-Identifier: Apache-2.0
#include "bench/fcl_baseline.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <algorithm>

namespace dismantle {

namespace {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclModel> make_fcl_model(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3& p : mesh.vertices) vertices.emplace_back(p.x, p.y, p.z);
  for (const Face& f : mesh.faces) triangles.emplace_back(f.v[0], f.v[1], f.v[2]);
  auto model = std::make_shared<FclModel>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d make_fcl_transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).matrix();
  t.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return t;
}

}  // namespace

class DiscreteFcl::Body {
 public:
  std::vector<std::shared_ptr<FclModel>> models;  // assembled
};

DiscreteFcl::DiscreteFcl(const Assembly& assembly) : body_(std::make_unique<Body>()) {
  for (const Component& c : assembly.components) body_->models.push_back(make_fcl_model(assembled_mesh(c)));
}

DiscreteFcl::~DiscreteFcl() = default;

int DiscreteFcl::colliding_pairs(Span<const ComponentId> in_hand, Span<const Pose> poses) const {
  int pairs = 0;
  const fcl::CollisionRequestd request;
  for (const ComponentId hand : in_hand) {
    const fcl::Transform3d moving = make_fcl_transform(poses[hand.value]);
    for (std::uint32_t c = 0; c < poses.size(); ++c) {
      if (std::find(in_hand.begin(), in_hand.end(), ComponentId(c)) != in_hand.end()) continue;
      fcl::CollisionResultd result;
      fcl::collide(body_->models[hand.value].get(), moving, body_->models[c].get(), make_fcl_transform(poses[c]),
                   request, result);
      pairs += result.isCollision() ? 1 : 0;
    }
  }
  return pairs;
}

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
