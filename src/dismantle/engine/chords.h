// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The chords that screws are divided into: continuous tests take the vertices along straight lines, while the true
/// paths are arcs.
namespace dismantle {

/// Maximum distance of the chords of a sweep from the true arcs, as a share of the tolerance; motions are divided until
/// they are that close. Every allowance is reduced by this share, even for translations, so that the guarantee holds
/// for the screw itself and a state reached by a translation is not too deep for a rotation.
inline constexpr double kArcShare = 0.125;

/// A motion that is stopped ends before the contact by this share of the tolerance [of path length] or, where the
/// contact is known by its time alone, of the motion up to it: the next sweep does not start at the limit of what is
/// allowed.
inline constexpr double kBackoffShare = 1e-3;

/// The number of equal screws that a motion must be divided into, so that the chords of each are within `max_deviation`
/// of its arcs; at least 1.
/// @param deviation of the whole motion: screw_chord_deviation [mm]
/// @param max_deviation [mm] @pre positive
int chord_count(double deviation, double max_deviation);

}  // namespace dismantle
