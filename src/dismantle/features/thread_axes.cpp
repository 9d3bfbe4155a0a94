// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_axes.h"

#include "dismantle/features/thread_fit.h"
#include "dismantle/features/thread_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

/// Relative difference between the distances from the axis of the ends of an edge along a helix, at most.
constexpr double kSameDistance = 2e-3;
/// Range of the angle between the ends of such an edge [rad].
constexpr double kMinAngle = 1e-3, kMaxAngle = 1.3;
/// Range of the lead of such an edge, relative to the distance from the axis.
constexpr double kMinLead = 0.03, kMaxLead = 6;
/// Leads with a smaller relative difference agree.
constexpr double kSameLead = 1e-3;
/// Mating threads: largest relative difference of the leads, sine between the axes, and distance between the axes
/// relative to the lead.
constexpr double kMatingLead = 5e-3, kMatingSine = 0.02, kMatingShare = 0.25;
/// Axes of a mesh that are examined, at most: those with the largest turns.
constexpr std::size_t kMaxAxes = 16;
/// Leads of each axis that are examined, at most: those with the longest edges.
constexpr std::size_t kMaxLeads = 3;
/// Smallest total angle of the edges of a lead [rad], and smallest share of that of all edges along helices.
constexpr double kMinTurn = kTurn, kMinShare = 0.05;
/// Edges that are examined for all axes together, at most: an evenly spaced sample of them.
constexpr std::size_t kMaxEdges = 4'000'000;

/// Remeshed threads: smallest number of faces of the mesh, and largest number of samples for the fit.
constexpr std::size_t kMinFaces = 400, kMaxSamples = 40'000;
/// Range of the search for their lead about that of the fit, relative to it, and its step in turns over the whole
/// thread.
constexpr double kLeadRange = 0.12, kLeadStep = 0.05;
/// Faces used by that search, and by the refinement of its best lead, at most.
constexpr std::size_t kMaxScanned = 2000, kMaxFitted = 10'000;
/// Steps of the refinement; each takes a third off the interval.
constexpr int kRefinements = 20;

/// Edges along helices of one lead.
struct Helices {
  double turn = 0;  ///< The sum of their angles [rad].
  double lead = 0;  ///< The sum of leads weighted by the angles; the mean lead when finished.
  /// Extent along the axis and distances from it [mm].
  double begin = std::numeric_limits<double>::infinity(), end = -begin, min_radius = begin, max_radius = 0;

  void add(const Helices& other) {
    turn += other.turn;
    lead += other.lead;
    begin = std::min(begin, other.begin);
    end = std::max(end, other.end);
    min_radius = std::min(min_radius, other.min_radius);
    max_radius = std::max(max_radius, other.max_radius);
  }
  /// True if a face may be of the thread that these are edges of.
  bool reach(const ProfileFace& face) const {
    const double play = std::abs(lead) / 4;
    const AxisCoordinates& at = face.centroid;
    return at.along >= begin - play && at.along <= end + play && at.distance >= min_radius - play &&
           at.distance <= max_radius + play;
  }
};

/// The edges of the mesh along helices about the axis, grouped by lead, sorted by descending total angle.
std::vector<Helices> helices(const AxisFrame& frame, Span<const Vec3> vertices, Span<const Face> faces,
                             std::size_t stride) {
  std::map<std::int64_t, Helices> cells;
  double all = 0;
  const double cell_count = 1 / kSameLead;
  for (std::size_t f = 0; f < faces.size(); f += stride)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = faces[f].v[k], w = faces[f].v[(k + 1) % 3];
      if (stride == 1 && v > w) continue;  // as the edge of its other face
      const double rise = dot(vertices[w] - vertices[v], frame.direction);
      const Vec3 from = frame.across(vertices[v]), to = frame.across(vertices[w]);
      const double distance = length(from), other = length(to);
      if (!(rise != 0) || !(std::abs(distance - other) <= kSameDistance * distance)) continue;
      const double angle = std::atan2(dot(frame.direction, cross(from, to)), dot(from, to));
      if (!(std::abs(angle) >= kMinAngle && std::abs(angle) <= kMaxAngle)) continue;
      const double lead = kTurn * rise / angle, size = std::abs(lead);
      if (!(size >= kMinLead * distance && size <= kMaxLead * distance)) continue;
      const auto cell = static_cast<std::int64_t>(std::floor(std::log(size) * cell_count));
      const double turn = std::abs(angle) * static_cast<double>(stride);
      const double low = frame.along(vertices[v]), high = low + rise;
      all += turn;
      cells[2 * cell + (lead < 0 ? 1 : 0)].add({turn, turn * lead, std::min(low, high), std::max(low, high),
                                                std::min(distance, other), std::max(distance, other)});
    }
  std::vector<Helices> sums, found;
  for (const auto& [cell, votes] : cells) {
    Helices sum = votes;
    if (const auto next = cells.find(cell + 2); next != cells.end()) sum.add(next->second);
    if (!(sum.turn >= std::max(kMinTurn, kMinShare * all))) continue;
    sum.lead /= sum.turn;
    sums.push_back(sum);
  }
  std::stable_sort(sums.begin(), sums.end(), [](const Helices& x, const Helices& y) { return x.turn > y.turn; });
  for (const Helices& sum : sums) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const Helices& other) {
      return std::abs(other.lead - sum.lead) <= 3 * kSameLead * std::abs(sum.lead);
    });
    if (!known && found.size() < kMaxLeads) found.push_back(sum);
  }
  return found;
}

std::optional<ThreadProfile> best_profile(Span<const Vec3> vertices, Span<const Face> faces, const RevolutionAxis& axis,
                                          std::size_t stride) {
  const AxisFrame frame(axis.point, axis.direction);
  std::optional<ThreadProfile> best;
  std::vector<ProfileFace> all;
  for (const Helices& edges : helices(frame, vertices, faces, stride)) {
    if (all.empty())
      for (const Face& f : faces)
        all.push_back(profile_face(frame, Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}}));
    std::vector<ProfileFace> near;
    for (const ProfileFace& face : all)
      if (may_be_flank(face) && edges.reach(face)) near.push_back(face);
    improve_profile(best, near, axis, edges.lead);
  }
  return best;
}

/// The area of possible flanks that agrees about its offset in the profile, as a function of the lead.
class Agreement {
 public:
  /// @param count of the faces to use, at most: an evenly spaced sample
  Agreement(const std::vector<ProfileFace>& faces, std::size_t count) {
    const std::size_t stride = 1 + faces.size() / count;
    std::array<FacesOfDirection, kProfileDirections> directions;
    for (const ProfileFace& face : faces) {
      FacesOfDirection& d = directions[profile_direction(face.normal)];
      d.radial += face.area * face.normal.radial;
      d.axial += face.area * face.normal.axial;
    }
    for (std::size_t i = 0; i < faces.size(); i += stride) {
      const ProfileFace& face = faces[i];
      const std::size_t direction = profile_direction(face.normal);
      const ProfileDirection normal = directions[direction].normal();
      seen_.push_back({direction, normal.radial / normal.axial * face.centroid.distance + face.centroid.along,
                       std::polar(face.area, -face.centroid.angle)});
    }
  }

  double area(double lead) const {
    std::array<std::complex<double>, kProfileDirections> sums{};
    for (const Seen& s : seen_) sums[s.direction] += s.turned * std::polar(1.0, kTurn * s.offset / lead);
    double area = 0;
    for (const std::complex<double>& sum : sums) area += std::abs(sum);
    return area;
  }

 private:
  struct Seen {
    std::size_t direction;
    double offset;                // of its plane: where that meets the axis at angle 0 [mm]
    std::complex<double> turned;  // its area, rotated by minus its angle
  };
  std::vector<Seen> seen_;
};

/// The lead near a rough one with which the most area agrees. The peak is narrow: it is located with few faces and
/// refined with more. @param turns of the thread
double sharpest_lead(const std::vector<ProfileFace>& faces, double rough, double turns) {
  const Agreement few(faces, kMaxScanned), many(faces, kMaxFitted);
  const double step = kLeadStep / std::max(1.0, turns);
  double best = rough, largest = 0;
  for (double off = -kLeadRange; off <= kLeadRange; off += step) {
    const double found = few.area(rough * (1 + off));
    if (found <= largest) continue;
    largest = found;
    best = rough * (1 + off);
  }
  double low = best * (1 - step), high = best * (1 + step);
  for (int i = 0; i < kRefinements; ++i) {
    const double x = low + (high - low) / 3, y = high - (high - low) / 3;
    if (many.area(x) < many.area(y)) {
      low = x;
    } else {
      high = y;
    }
  }
  return (low + high) / 2;
}

/// The thread of a remeshed surface, which has no edges along helices: a fit gives the axis and roughly the lead.
std::optional<ThreadProfile> remeshed_profile(Span<const Vec3> vertices, Span<const Face> faces) {
  if (faces.size() < kMinFaces) return std::nullopt;
  const std::optional<ThreadAxis> rough = fit_thread(curved_samples(vertices, faces, kMaxSamples));
  if (!rough) return std::nullopt;
  const AxisFrame frame(rough->point, rough->direction);
  std::vector<ProfileFace> near;
  for (const Face& f : faces) {
    const ProfileFace face = profile_face(frame, Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    const AxisCoordinates& at = face.centroid;
    if (may_be_flank(face) && at.along >= rough->begin && at.along <= rough->end && at.distance <= rough->max_radius)
      near.push_back(face);
  }
  const double lead = sharpest_lead(near, rough->lead, (rough->end - rough->begin) / std::abs(rough->lead));
  std::optional<ThreadProfile> best;
  improve_profile(best, near, {rough->point, rough->direction}, lead);
  return best;
}

}  // namespace

std::vector<ThreadAxis> thread_axes(Span<const Vec3> vertices, Span<const Face> faces,
                                    Span<const RevolutionAxis> axes) {
  std::vector<ThreadAxis> threads;
  const std::size_t count = std::min(axes.size(), kMaxAxes), stride = 1 + 3 * faces.size() * count / kMaxEdges;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::optional<ThreadProfile> profile = best_profile(vertices, faces, axes[i], stride))
      threads.push_back(profile->thread);
  if (threads.empty())
    if (const std::optional<ThreadProfile> profile = remeshed_profile(vertices, faces))
      threads.push_back(profile->thread);
  return threads;
}

bool threads_mate(const ThreadAxis& x, const ThreadAxis& y) {
  const double lead = std::min(std::abs(x.lead), std::abs(y.lead));
  return x.radial_sum() * y.radial_sum() < 0 && x.starts == y.starts &&
         std::abs(x.lead - y.lead) <= kMatingLead * lead && length(cross(x.direction, y.direction)) <= kMatingSine &&
         length(AxisFrame(y.point, y.direction).across(x.point)) <= kMatingShare * lead;
}

const ThreadAxis& better_known(const ThreadAxis& x, const ThreadAxis& y) {
  return x.end - x.begin >= y.end - y.begin ? x : y;
}

}  // namespace dismantle
