// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/certificate_sweeper.h"

#include <vector>

namespace dismantle {

/// The contacts of CertificateEngine::contacts.
std::vector<ContactPoint> contacts_within(const CertificateSweeper& sweeper, double reach);

/// The clearance of CertificateEngine::clearance.
Clearance least_clearance(const CertificateSweeper& sweeper);

/// The batch of CertificateEngine::first_contacts.
std::vector<FirstContact> first_contacts(const CertificateSweeper& sweeper, Span<const Pose> targets);

}  // namespace dismantle
