// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/sweep/certificate_sweeper.h"

#include <optional>
#include <vector>

namespace dismantle {

/// The result of CertificateEngine::contacts() from CertificateSweeper::near_pairs(), which contain them.
std::vector<ContactPoint> contacts_of(const CertificateSweeper& sweeper, Span<const SweepContact> pairs, double reach);

/// The result of CertificateEngine::contact().
ContactPoint contact_of(const CertificateSweeper& sweeper, const NearFaces& faces);

/// The result of CertificateEngine::near_faces() from CertificateSweeper::near_pairs(), which contain them.
std::vector<NearFaces> near_faces_of(const CertificateSweeper& sweeper, Span<const SweepContact> pairs, double reach);

/// The result of CertificateEngine::clearance().
Clearance min_clearance(const CertificateSweeper& sweeper, double limit);

/// The result of CertificateEngine::first_contact().
FirstContact first_contact(const CertificateSweeper& sweeper, const Pose& target);

/// The result of CertificateEngine::straight_contact(); distances are along the displacement.
std::optional<StraightContact> straight_contact(const CertificateSweeper& sweeper, const LinearMotion& motion,
                                                StraightSearch search);

/// The result of CertificateEngine::straight_contacts().
std::vector<FirstContact> straight_contacts(const CertificateSweeper& sweeper, Span<const Vec3> displacements);

}  // namespace dismantle
