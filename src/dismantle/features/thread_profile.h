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

/// How a thread's faces lie in its profile, the plane of the distance from the axis and the lift: what finding threads
/// and sorting their faces share.
namespace dismantle {

/// A place about an axis.
struct AxisPlace {
  double distance = 0, angle = 0, along = 0;
  double lift(double lead) const { return along - lead * angle / kTurn; }
};

/// A face about an axis.
struct ProfileFace {
  AxisPlace centroid, corner[3];
  ProfileDirection normal;  ///< Unit, or zero for one that faces around the axis.
  double area = 0;
};

ProfileFace profile_face(const AxisFrame& frame, const Triangle& t);

/// Whether the face is neither a crest's or a root's, nor beside the thread.
bool may_be_flank(const ProfileFace& face);

/// Whether all corners of the face are on the flank, nearly. @param period of the profile [mm]
bool on_flank(const ThreadAxis::Flank& flank, const ProfileFace& face, double lead, double period);

/// Outward normals in the profile are sorted into so many directions.
inline constexpr int kProfileDirections = 72;
/// The direction of a normal, from 0 on.
std::size_t profile_direction(ProfileDirection normal);

/// Faces whose outward normals in the profile are alike.
struct FacesOfDirection {
  double area = 0, radial = 0, lift = 0;  // sums
  std::complex<double> place, angle;      // where they are in the profile and around the axis
  std::vector<const ProfileFace*> faces;
  ProfileDirection normal() const {
    const double size = std::hypot(radial, lift);
    return {radial / size, lift / size};
  }
};

/// The thread that the faces have with some lead; the more of their area agrees about it the better.
struct ThreadProfile {
  ThreadAxis thread;
  double area = 0;
};

/// Takes the thread that faces, which may be flanks, have about an axis with some lead, if it leads on and back, for
/// the best one so far where far more area agrees about it; with every number of starts. @param lead signed [mm]
void improve_profile(std::optional<ThreadProfile>& best, const std::vector<ProfileFace>& faces,
                     const RevolutionAxis& axis, double lead);

}  // namespace dismantle
