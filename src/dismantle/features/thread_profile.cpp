// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_profile.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Directions of the profile that one flank takes, at most.
constexpr int kMaxOfFlank = 6;
/// Smallest area of a flank, relative to the largest one.
constexpr double kMinOfLargest = 0.1;
/// Smallest axial component of a flank's normal.
constexpr double kMinAxial = 0.15;
/// Smallest agreement of a flank's faces about its offset: 1 if all have the same, 0 if they are all over the profile.
constexpr double kMinAgreement = 0.75;
/// Largest agreement of a flank's faces about the angle: flanks go around the axis.
constexpr double kMaxOneSided = 0.3;
/// Largest distance from a flank of the centroids that it is fitted to, in periods.
constexpr double kNearOffset = 0.12;
/// Largest distance from a flank of the corners of its faces, in periods.
constexpr double kSameOffset = 0.02;
constexpr int kMaxStarts = 4;
/// Another lead or number of starts is preferred if the flanks have so many times the area.
constexpr double kMuchMore = 1.5;

AxisCoordinates coordinates_of(const AxisFrame& frame, Vec3 p) {
  const Vec3 across = frame.across(p);
  return {length(across), frame.angle(across), frame.along(p)};
}

using Directions = std::array<FacesOfDirection, kProfileDirections>;

double along(ProfileDirection normal, const AxisCoordinates& at, double lead) {
  return normal.radial * at.distance + normal.axial * at.axial_offset(lead);
}

/// The distance of a point from the flank, in periods: between -0.5 and 0.5.
double periods_off(const ThreadAxis::Flank& flank, const AxisCoordinates& at, double lead, double period) {
  const double off = (along(flank.normal, at, lead) - flank.offset) / (flank.normal.axial * period);
  return off - std::round(off);
}

/// An offset along a normal as a phase of the profile, a turn per period.
std::complex<double> phase(ProfileDirection normal, double offset, double period) {
  return std::polar(1.0, kTurn * offset / (normal.axial * period));
}

/// The runs of adjacent directions in which the faces agree about their offset.
std::vector<std::vector<std::size_t>> agreeing(const Directions& directions) {
  std::vector<std::vector<std::size_t>> runs;
  double all = 0;
  for (const FacesOfDirection& d : directions) all += d.area;
  for (std::size_t i = 0; i < kProfileDirections; ++i) {
    const FacesOfDirection& d = directions[i];
    const bool agrees = d.area > 1e-3 * all && std::abs(d.phase_sum) >= kMinAgreement * d.area &&
                        std::abs(d.angle_sum) <= kMaxOneSided * d.area;
    if (!agrees) continue;
    const bool goes_on = !runs.empty() && runs.back().back() + 1 == i && runs.back().size() < kMaxOfFlank &&
                         directions[i - 1].axial * d.axial > 0;
    if (goes_on) {
      runs.back().push_back(i);
    } else {
      runs.push_back({i});
    }
  }
  const auto area = [&](const std::vector<std::size_t>& run) {
    double sum = 0;
    for (const std::size_t i : run) sum += directions[i].area;
    return sum;
  };
  double largest = 0;
  for (const std::vector<std::size_t>& run : runs) largest = std::max(largest, area(run));
  std::erase_if(runs, [&](const std::vector<std::size_t>& run) { return area(run) < kMinOfLargest * largest; });
  return runs;
}

/// The line in the profile plane that fits the corners of the flank's faces best, near a rough one.
ThreadAxis::Flank fitted(const ThreadAxis::Flank& rough, const std::vector<const ProfileFace*>& faces, double lead,
                         double period) {
  // Moments of the coordinates across and along the rough line.
  double sum_off = 0, sum_far = 0, off_off = 0, far_far = 0, off_far = 0, count = 0;
  for (const ProfileFace* face : faces) {
    if (std::abs(periods_off(rough, face->centroid, lead, period)) > kNearOffset) continue;
    for (const AxisCoordinates& at : face->corner) {
      const double off = periods_off(rough, at, lead, period) * rough.normal.axial * period;
      // The axial offset follows from off = normal.radial * distance + normal.axial * axial - offset, in one period.
      const double axial = (off + rough.offset - rough.normal.radial * at.distance) / rough.normal.axial;
      const double far = rough.normal.axial * at.distance - rough.normal.radial * axial;
      sum_off += off;
      sum_far += far;
      off_off += off * off;
      far_far += far * far;
      off_far += off * far;
      ++count;
    }
  }
  if (count == 0) return rough;
  const double mean_off = sum_off / count, mean_far = sum_far / count;
  const double tilt = std::atan2(2 * (off_far / count - mean_off * mean_far),
                                 far_far / count - mean_far * mean_far - off_off / count + mean_off * mean_off) /
                      2;
  const double cosine = std::cos(tilt), sine = std::sin(tilt);
  const ProfileDirection n = rough.normal;
  ThreadAxis::Flank flank;
  flank.normal = {cosine * n.radial - sine * n.axial, cosine * n.axial + sine * n.radial};
  flank.offset = cosine * (rough.offset + mean_off) - sine * mean_far;
  return flank;
}

/// Sorts faces by the direction of their normals. @param faces that may be flanks
Directions by_direction(const std::vector<ProfileFace>& faces, double lead, double period) {
  Directions directions;
  for (const ProfileFace& face : faces) {
    FacesOfDirection& d = directions[profile_direction(face.normal)];
    d.faces.push_back(&face);
    d.area += face.area;
    d.radial += face.area * face.normal.radial;
    d.axial += face.area * face.normal.axial;
  }
  for (FacesOfDirection& d : directions)
    for (const ProfileFace* face : d.faces) {
      d.phase_sum += face->area * phase(d.normal(), along(d.normal(), face->centroid, lead), period);
      d.angle_sum += std::polar(face->area, face->centroid.angle);
    }
  return directions;
}

/// The sum over the directions of a run.
FacesOfDirection sum_of(const Directions& directions, const std::vector<std::size_t>& run) {
  FacesOfDirection sum;
  for (const std::size_t i : run) {
    const FacesOfDirection& d = directions[i];
    sum.area += std::abs(d.phase_sum);
    sum.radial += d.radial;
    sum.axial += d.axial;
    sum.faces.insert(sum.faces.end(), d.faces.begin(), d.faces.end());
  }
  return sum;
}

/// The flank that faces of one direction are on.
ThreadAxis::Flank flank_of(const FacesOfDirection& d, double lead, double period) {
  ThreadAxis::Flank flank{d.normal(), 0};
  std::complex<double> sum;
  for (const ProfileFace* face : d.faces)
    sum += face->area * phase(flank.normal, along(flank.normal, face->centroid, lead), period);
  flank.offset = std::arg(sum) / kTurn * flank.normal.axial * period;
  return fitted(flank, d.faces, lead, period);
}

/// Extends the thread to the faces on its flank.
void extend(ThreadAxis& thread, const ThreadAxis::Flank& flank, const std::vector<const ProfileFace*>& faces,
            double period) {
  for (const ProfileFace* face : faces) {
    if (!on_flank(flank, *face, thread.lead, period)) continue;
    for (const AxisCoordinates& corner : face->corner) {
      thread.begin = std::min(thread.begin, corner.along);
      thread.end = std::max(thread.end, corner.along);
      thread.min_radius = std::min(thread.min_radius, corner.distance);
      thread.max_radius = std::max(thread.max_radius, corner.distance);
    }
  }
}

/// The thread that faces have with a lead and a number of starts. @param faces that may be flanks
std::optional<ThreadProfile> profile_of(const std::vector<ProfileFace>& faces, const RevolutionAxis& axis, double lead,
                                        int starts) {
  const double period = std::abs(lead) / starts;
  const Directions directions = by_direction(faces, lead, period);
  ThreadProfile found;
  ThreadAxis& thread = found.thread;
  thread.point = axis.point;
  thread.direction = axis.direction;
  thread.lead = lead;
  thread.starts = starts;
  thread.begin = thread.min_radius = std::numeric_limits<double>::infinity();
  thread.end = -thread.begin;
  bool has_forward = false, has_backward = false;
  for (const std::vector<std::size_t>& run : agreeing(directions)) {
    const FacesOfDirection sum = sum_of(directions, run);
    const ThreadAxis::Flank flank = flank_of(sum, lead, period);
    extend(thread, flank, sum.faces, period);
    thread.flanks.push_back(flank);
    found.area += sum.area;
    (flank.normal.axial > 0 ? has_forward : has_backward) = true;
  }
  if (!has_forward || !has_backward || thread.min_radius > thread.max_radius) return std::nullopt;
  return found;
}

}  // namespace

ProfileFace profile_face(const AxisFrame& frame, const Triangle& t) {
  ProfileFace face;
  const Vec3 normal = normal_unscaled(t), centroid = (t[0] + t[1] + t[2]) / 3;
  face.centroid = coordinates_of(frame, centroid);
  for (int i = 0; i < 3; ++i) face.corner[i] = coordinates_of(frame, t[i]);
  face.area = length(normal) / 2;
  if (!(face.area > 0) || !(face.centroid.distance > 0)) return face;
  const double radial = dot(normal, frame.across(centroid)) / face.centroid.distance;
  const double axial = dot(normal, frame.direction);
  const double size = std::hypot(radial, axial);
  face.normal = size > face.area ? ProfileDirection{radial / size, axial / size} : ProfileDirection{0, 0};
  return face;
}

bool may_be_flank(const ProfileFace& face) {
  return std::abs(face.normal.axial) >= kMinAxial;
}

bool on_flank(const ThreadAxis::Flank& flank, const ProfileFace& face, double lead, double period) {
  return std::all_of(std::begin(face.corner), std::end(face.corner), [&](const AxisCoordinates& corner) {
    return std::abs(periods_off(flank, corner, lead, period)) <= kSameOffset;
  });
}

std::size_t profile_direction(ProfileDirection normal) {
  const double turned = std::atan2(normal.axial, normal.radial) / kTurn + 0.5;
  return std::min<std::size_t>(kProfileDirections - 1, static_cast<std::size_t>(turned * kProfileDirections));
}

void improve_profile(std::optional<ThreadProfile>& best, const std::vector<ProfileFace>& faces,
                     const RevolutionAxis& axis, double lead) {
  for (int starts = 1; starts <= kMaxStarts; ++starts) {
    std::optional<ThreadProfile> found = profile_of(faces, axis, lead, starts);
    if (found && (!best || found->area > kMuchMore * best->area)) best = std::move(found);
  }
}

}  // namespace dismantle
