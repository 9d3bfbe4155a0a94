// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_body.h"
#include "dismantle/audit/solid/surface_piece.h"
#include "dismantle/core/span.h"

#include <cstdint>

namespace dismantle::audit {

/// The point of a triangle that is closest to `point` [mm].
Vec3 closest_point(const Triangle& t, Vec3 point);

/// True if all points of a piece stay within `limit` of one triangle: the distance to a triangle is convex, so it is
/// largest at a corner, at the begin or at the end.
bool stays_within(const SurfacePiece& piece, const Triangle& t, double limit);

/// True if all points of a piece stay within `limit` of one triangle or of another one: a plane cuts the hull of the
/// corners in two, of which each is within the limit of one of them. It is the one on which points are as high over the
/// plane of either triangle as over that of the other, on the side where the piece is.
bool stays_within_either(const SurfacePiece& piece, const Triangle& s, const Triangle& t, double limit);

/// True if the piece, shifted by `shift`, certainly does not meet the triangle during its slice: some axis separates
/// them at both ends by more than the deviation and `margin`.
bool passes_clear(const SurfacePiece& piece, Vec3 shift, const Triangle& t, double margin);

/// True if the shifted piece certainly does not meet any of the faces of a body.
bool passes_clear(const SurfacePiece& piece, Vec3 shift, const AuditBody& body, Span<const std::uint32_t> faces,
                  double margin);

}  // namespace dismantle::audit
