// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_engine.h"

#include "dismantle/certificates/certificate_queries.h"
#include "dismantle/certificates/response/certificate_response.h"
#include "dismantle/core/contract.h"

#include <algorithm>
#include <utility>

namespace dismantle {

class CertificateEngine::Impl {
 public:
  Impl(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options, CertificateDevice device)
      : sweeper(assembly, pairs, options, std::move(device)), response(sweeper) {}

  CertificateSweeper sweeper;
  CertificateResponse response;
};

CertificateEngine::CertificateEngine(const Assembly& assembly, const PairStates& pairs,
                                     const CertificateOptions& options, CertificateDevice device)
    : impl_(std::make_unique<Impl>(assembly, pairs, options, std::move(device))) {}

CertificateEngine::~CertificateEngine() = default;
CertificateEngine::CertificateEngine(CertificateEngine&&) noexcept = default;
CertificateEngine& CertificateEngine::operator=(CertificateEngine&&) noexcept = default;

void CertificateEngine::grab(Span<const ComponentId> components) {
  impl_->sweeper.grab(components);
  impl_->response.begin();
}

Span<const ComponentId> CertificateEngine::moving_set() const {
  return impl_->sweeper.moving_set();
}

StepResult CertificateEngine::step(const Pose& target, ResponseKind response) {
  DISMANTLE_EXPECT(!impl_->sweeper.moving_set().empty());
  return impl_->response.step(target, response);
}

void CertificateEngine::jump(Span<const Pose> poses) {
  impl_->response.jump(poses);
}

Span<const Pose> CertificateEngine::poses() const {
  return impl_->sweeper.poses();
}

std::vector<ComponentPair> CertificateEngine::overlapping_pairs() const {
  return impl_->sweeper.overlapping_pairs();
}

std::vector<ContactPoint> CertificateEngine::contacts(double reach) const {
  return contacts_of(impl_->sweeper, impl_->sweeper.near_pairs(reach), reach);
}

std::vector<NearFaces> CertificateEngine::near_faces(ComponentId component, double reach) const {
  return near_faces_of(impl_->sweeper, impl_->sweeper.near_pairs(component, reach), reach);
}

ContactPoint CertificateEngine::contact(const NearFaces& faces) const {
  return contact_of(impl_->sweeper, faces);
}

Clearance CertificateEngine::clearance(double limit) const {
  return min_clearance(impl_->sweeper, limit);
}

FirstContact CertificateEngine::first_contact(const Pose& target) const {
  DISMANTLE_EXPECT(!impl_->sweeper.moving_set().empty());
  return dismantle::first_contact(impl_->sweeper, target);
}

std::vector<FirstContact> CertificateEngine::straight_contacts(Span<const Vec3> displacements) const {
  DISMANTLE_EXPECT(!impl_->sweeper.moving_set().empty());
  return dismantle::straight_contacts(impl_->sweeper, displacements);
}

std::optional<StraightContact> CertificateEngine::straight_contact(ComponentId moving, ComponentId fixed,
                                                                   const Vec3& displacement,
                                                                   StraightSearch search) const {
  return dismantle::straight_contact(impl_->sweeper, {moving, fixed, displacement, {}, {}}, search);
}

std::shared_ptr<const AssemblySurfaces> CertificateEngine::surfaces() const {
  return impl_->sweeper.surfaces();
}

std::size_t CertificateEngine::front_size() const {
  return impl_->sweeper.front_size();
}

}  // namespace dismantle
