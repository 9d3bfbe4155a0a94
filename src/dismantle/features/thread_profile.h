// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/features/axis_frame.h"
#include "dismantle/features/thread_axes.h"
#include "dismantle/geometry/triangle.h"
#include "dismantle/math/angle.h"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

/// Faces in the profile plane of a thread, whose coordinates are (distance from the axis, axial offset).
namespace dismantle {

/// Cylindrical coordinates about an axis.
struct AxisCoordinates {
  double distance = 0;  ///< From the axis [mm].
  double angle = 0;     ///< In (-pi, pi].
  double along = 0;     ///< Position along the axis [mm].

  /// The position along the axis less the advance of a helix of this lead over the angle [mm].
  double axial_offset(double lead) const { return along - lead * angle / kTurn; }
};

/// A face in coordinates about an axis.
struct ProfileFace {
  AxisCoordinates centroid;   ///< Mean of the corners.
  AxisCoordinates corner[3];  ///< In the order of the face.
  ProfileDirection normal;    ///< Unit, or zero for a face whose normal is nearly tangential.
  double area = 0;            ///< [mm^2]
};

/// A triangle in coordinates about an axis.
ProfileFace profile_face(const AxisFrame& frame, const Triangle& t);

/// True if the face's normal has enough of the axis' direction for a flank: not that of a crest or a root.
bool may_be_flank(const ProfileFace& face);

/// True if all corners of the face are nearly on the flank, in any period. @param period of the profile [mm]
bool on_flank(const ThreadAxis::Flank& flank, const ProfileFace& face, double lead, double period);

/// Number of directions that outward normals in the profile plane are sorted into.
inline constexpr int kProfileDirections = 72;
/// The direction of a normal, in [0, kProfileDirections).
std::size_t profile_direction(ProfileDirection normal);

/// Faces whose outward normals in the profile plane are alike, with sums over them weighted by area.
struct FacesOfDirection {
  double area = 0;                        ///< [mm^2]
  double radial = 0;                      ///< Sum of the normals' radial components [mm^2].
  double axial = 0;                       ///< Sum of the normals' axial components [mm^2].
  std::complex<double> phase_sum;         ///< Of unit complex numbers for the faces' offsets, a turn a period [mm^2].
  std::complex<double> angle_sum;         ///< Of unit complex numbers for the faces' angles about the axis [mm^2].
  std::vector<const ProfileFace*> faces;  ///< Owned by the caller.

  /// The mean normal.
  ProfileDirection normal() const {
    const double size = std::hypot(radial, axial);
    return {radial / size, axial / size};
  }
};

/// A thread that faces have with some lead.
struct ThreadProfile {
  ThreadAxis thread;  ///< With its flanks.
  double area = 0;    ///< Area of the faces that agree about the flanks' offsets: the more, the better [mm^2].
};

/// Replaces the best thread so far by the one that the faces have about an axis with this lead, for any number of
/// starts, if it has flanks of both directions and much more area agrees about it.
/// @param faces that may be flanks
/// @param lead signed [mm]
void improve_profile(std::optional<ThreadProfile>& best, const std::vector<ProfileFace>& faces,
                     const RevolutionAxis& axis, double lead);

}  // namespace dismantle
