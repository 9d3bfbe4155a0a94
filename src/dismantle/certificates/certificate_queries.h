// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The contacts of CertificateEngine::contacts.
std::vector<ContactPoint> contacts_within(const CertificateSweeper& sweeper, double reach);

/// The clearance of CertificateEngine::clearance.
Clearance min_clearance(const CertificateSweeper& sweeper, double limit);

/// The batch of CertificateEngine::first_contacts.
std::vector<FirstContact> first_contacts(const CertificateSweeper& sweeper, Span<const Pose> targets);

/// The answer of CertificateEngine::straight_contact; the distance is along the way.
std::optional<StraightContact> straight_contact(const CertificateSweeper& sweeper, const StraightWay& asked,
                                                StraightSearch search);

/// The batch of CertificateEngine::straight_contacts.
std::vector<FirstContact> straight_contacts(const CertificateSweeper& sweeper, Span<const Vec3> ways);

}  // namespace dismantle
