// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"

#include <vector>

namespace dismantle {

/// The corners of a flat convex polygon in order [mm]: a piece of a triangle in a branch and bound over a surface.
using ConvexPolygon = std::vector<Vec3>;

/// The mean of the corners. @pre there is a corner
Vec3 centroid_of(const ConvexPolygon& polygon);

/// The largest distance of a corner from `center`, and with it of any point [mm].
double radius_about(const ConvexPolygon& polygon, Vec3 center);

/// The polygon scaled about a point. @param scale 1 for the polygon itself
ConvexPolygon scaled_about(const ConvexPolygon& polygon, Vec3 center, double scale);

/// Cuts a piece of one surface along the sides of a triangle of another one, extruded along its normal, so that the
/// distance from that triangle bounds the part above it tightly; through its centroid where that separates nothing. The
/// part at the centroid comes last. @return at least one polygon, each with at least one corner
std::vector<ConvexPolygon> divided(const ConvexPolygon& piece, const Triangle& below);

/// Cuts a polygon along the plane of a triangle into two, none of which the triangle cuts; as divided() does where the
/// plane separates nothing.
std::vector<ConvexPolygon> divided_by_plane(const ConvexPolygon& piece, const Triangle& across);

/// Cuts a polygon where it is equally far from the planes of two triangles; as divided() does by the first one where
/// that separates nothing.
std::vector<ConvexPolygon> divided_between(const ConvexPolygon& piece, const Triangle& first, const Triangle& second);

/// Halves a polygon through its centroid, across its longest extent from there.
std::vector<ConvexPolygon> halved(const ConvexPolygon& piece);

}  // namespace dismantle
