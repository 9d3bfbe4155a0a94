// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/certificate_engine.h"

#include "dismantle/certificates/certificate_queries.h"
#include "dismantle/certificates/response/certificate_response.h"
#include "dismantle/core/contract.h"

#include <algorithm>
#include <utility>

namespace dismantle {

class CertificateEngine::Body {
 public:
  Body(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options, CertificateDevice device)
      : sweeper(assembly, pairs, options, std::move(device)), response(sweeper, assembly, pairs) {}

  CertificateSweeper sweeper;
  CertificateResponse response;
};

CertificateEngine::CertificateEngine(const Assembly& assembly, const PairStates& pairs,
                                     const CertificateOptions& options, CertificateDevice device)
    : body_(std::make_unique<Body>(assembly, pairs, options, std::move(device))) {}

CertificateEngine::~CertificateEngine() = default;
CertificateEngine::CertificateEngine(CertificateEngine&&) noexcept = default;
CertificateEngine& CertificateEngine::operator=(CertificateEngine&&) noexcept = default;

void CertificateEngine::hold(Span<const ComponentId> components) {
  body_->sweeper.hold(components);
  body_->response.begin();
}

StepResult CertificateEngine::step(const Pose& target, ResponseKind response) {
  DISMANTLE_EXPECT(!body_->sweeper.held().empty());
  return body_->response.step(target, response);
}

void CertificateEngine::jump(Span<const Pose> poses) {
  body_->response.jump(poses);
}

Span<const Pose> CertificateEngine::poses() const {
  return body_->sweeper.poses();
}

std::vector<ComponentPair> CertificateEngine::embedded_pairs() const {
  return body_->response.embedded_pairs();
}

std::vector<ContactPoint> CertificateEngine::contacts(double reach) const {
  return contacts_within(body_->sweeper, reach);
}

Clearance CertificateEngine::clearance(double limit) const {
  return min_clearance(body_->sweeper, limit);
}

std::vector<FirstContact> CertificateEngine::first_contacts(Span<const Pose> targets) const {
  return dismantle::first_contacts(body_->sweeper, targets);
}

std::vector<FirstContact> CertificateEngine::straight_contacts(Span<const Vec3> ways) const {
  return dismantle::straight_contacts(body_->sweeper, ways);
}

std::optional<StraightContact> CertificateEngine::straight_contact(ComponentId moving, ComponentId fixed,
                                                                   const Vec3& way, StraightSearch search) const {
  return dismantle::straight_contact(body_->sweeper, {moving, fixed, way, {}, {}}, search);
}

std::size_t CertificateEngine::front_size() const {
  return body_->sweeper.front_size();
}

}  // namespace dismantle
