// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/scene.h"
#include "tests/support/meshes.h"

#include <algorithm>

/// Meshes of the families.
namespace dismantle::families {

using Lines = std::vector<double>;

/// A prism below z = 0 whose top is divided along lines.
/// @param xs, ys ascending, at least two each
TriangleMesh gridded_block(const Lines& xs, const Lines& ys, double depth);
/// A pyramid or cone with its tip at the origin, opening along +z.
TriangleMesh spike(int sides, double radius, double height);
/// A wedge with its edge along x through the origin, opening along +z.
TriangleMesh wedge(double half_length, double half_angle, double height);
/// An open sheet at about z = 0, faces up, with waves.
TriangleMesh waved_sheet(double half, int cells, double waves, double phase);
/// A cylinder along z from z = 0 to `height` with a blind hole from the top down to `bottom`.
TriangleMesh blind_hole(int sides, double hole, double outer, double bottom, double height);
/// The convex hull of some points. @pre in general position
TriangleMesh convex_hull(const std::vector<Vec3>& points);
/// A ball of 20 * 4^divisions faces.
TriangleMesh ball(int divisions);
/// Gives edges of some faces a vertex in their middle that the neighbour does not have, and moves it by up to `gap`.
TriangleMesh cracked(TriangleMesh mesh, int count, double gap, Dice& dice);
/// The mesh with all faces turned round.
TriangleMesh turned_round(TriangleMesh mesh);
/// Both meshes as one.
TriangleMesh together(TriangleMesh a, const TriangleMesh& b);
/// The mesh moved.
TriangleMesh shifted(TriangleMesh mesh, Vec3 by);
/// Evenly spaced numbers.
Lines even_lines(double low, double high, int count);

}  // namespace dismantle::families
