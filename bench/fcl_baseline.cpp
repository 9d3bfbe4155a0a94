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

class DiscreteFcl::Impl {
 public:
  std::vector<std::shared_ptr<FclModel>> models;  // assembled
};

DiscreteFcl::DiscreteFcl(const Assembly& assembly) : impl_(std::make_unique<Impl>()) {
  for (const Component& c : assembly.components) impl_->models.push_back(make_fcl_model(assembled_mesh(c)));
}

DiscreteFcl::~DiscreteFcl() = default;

int DiscreteFcl::colliding_pairs(Span<const ComponentId> moving_set, Span<const Pose> poses) const {
  int pairs = 0;
  const fcl::CollisionRequestd request;
  for (const ComponentId moving : moving_set) {
    const fcl::Transform3d world_from_moving = make_fcl_transform(poses[moving.value]);
    for (std::uint32_t c = 0; c < poses.size(); ++c) {
      if (std::find(moving_set.begin(), moving_set.end(), ComponentId(c)) != moving_set.end()) continue;
      fcl::CollisionResultd result;
      fcl::collide(impl_->models[moving.value].get(), world_from_moving, impl_->models[c].get(),
                   make_fcl_transform(poses[c]), request, result);
      pairs += result.isCollision() ? 1 : 0;
    }
  }
  return pairs;
}

FclMotionResult continuous_fcl(const TriangleMesh& fixed, const TriangleMesh& moving, const Pose& start,
                               const Pose& end, FclSolver solver) {
  const auto fixed_model = make_fcl_model(fixed), moving_model = make_fcl_model(moving);
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_SCREW;
  request.ccd_solver_type = solver == FclSolver::Naive ? fcl::CCDC_NAIVE : fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(moving_model.get(), make_fcl_transform(start), make_fcl_transform(end), fixed_model.get(),
                         identity, identity, request, result);
  return {!result.is_collide, result.is_collide ? result.time_of_contact : 1};
}

}  // namespace dismantle
