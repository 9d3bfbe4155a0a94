// SPDX-License-Identifier: Apache-2.0
#include "bench/discrete_fcl.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <algorithm>

namespace dismantle {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> make_model(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3& p : mesh.vertices) vertices.emplace_back(p.x, p.y, p.z);
  for (const Face& f : mesh.faces) triangles.emplace_back(f.v[0], f.v[1], f.v[2]);
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d make_transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).matrix();
  t.translation() = fcl::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return t;
}

}  // namespace

class DiscreteFcl::Body {
 public:
  std::vector<std::shared_ptr<Model>> models;  // assembled
};

DiscreteFcl::DiscreteFcl(const Assembly& assembly) : body_(std::make_unique<Body>()) {
  for (const Component& c : assembly.components) body_->models.push_back(make_model(assembled_mesh(c)));
}

DiscreteFcl::~DiscreteFcl() = default;

int DiscreteFcl::colliding_pairs(Span<const ComponentId> in_hand, Span<const Pose> poses) const {
  int pairs = 0;
  const fcl::CollisionRequestd request;
  for (const ComponentId hand : in_hand) {
    const fcl::Transform3d moving = make_transform(poses[hand.value]);
    for (std::uint32_t c = 0; c < poses.size(); ++c) {
      if (std::find(in_hand.begin(), in_hand.end(), ComponentId(c)) != in_hand.end()) continue;
      fcl::CollisionResultd result;
      fcl::collide(body_->models[hand.value].get(), moving, body_->models[c].get(), make_transform(poses[c]), request,
                   result);
      pairs += result.isCollision() ? 1 : 0;
    }
  }
  return pairs;
}

}  // namespace dismantle
