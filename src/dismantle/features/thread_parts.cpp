// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_profile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <utility>

namespace dismantle {

namespace {

/// Smallest cosine between the normal of a face and that of its flank.
constexpr double kOfFlank = 0.85;
/// Largest difference between the axial offset of a corner and that of its crest or root, in periods.
constexpr double kOfBand = 0.25;

/// The distance from the axis that separates crests from roots: midway between the means of the two (2-means).
double between_crest_and_root(const std::vector<double>& distances) {
  const auto [nearest, furthest] = std::minmax_element(distances.begin(), distances.end());
  if (nearest == distances.end()) return 0;
  double low = *nearest, high = *furthest;
  for (int i = 0; i < 4; ++i) {
    const double middle = (low + high) / 2;
    double sums[2] = {0, 0}, counts[2] = {0, 0};
    for (const double d : distances) {
      sums[d >= middle] += d;
      ++counts[d >= middle];
    }
    if (counts[0] > 0) low = sums[0] / counts[0];
    if (counts[1] > 0) high = sums[1] / counts[1];
  }
  return (low + high) / 2;
}

/// The part of the thread's profile that the face belongs to, from 1: a flank, or the next number for crests and roots;
/// 0 for none.
std::size_t part_of(const ThreadAxis& thread, const ProfileFace& face) {
  const double period = std::abs(thread.lead) / thread.starts;
  const double play = (thread.max_radius - thread.min_radius) / 4;
  const AxisCoordinates& at = face.centroid;
  if (at.along < thread.begin - period || at.along > thread.end + period) return 0;
  if (at.distance < thread.min_radius - play || at.distance > thread.max_radius + play) return 0;
  for (std::size_t i = 0; i < thread.flanks.size(); ++i) {
    const ThreadAxis::Flank& flank = thread.flanks[i];
    if (flank.normal.radial * face.normal.radial + flank.normal.axial * face.normal.axial < kOfFlank) continue;
    if (on_flank(flank, face, thread.lead, period)) return 1 + i;
  }
  // Crests and roots face in the radial direction that the flanks lean to; those of a square thread may face either.
  const double radial = face.normal.radial, sum = thread.radial_sum();
  return std::abs(radial) < kOfFlank || radial * sum < 0 ? 0 : thread.flanks.size() + 1;
}

}  // namespace

std::vector<std::uint8_t> thread_parts(Span<const Vec3> vertices, Span<const Face> faces,
                                       Span<const ThreadAxis> threads) {
  std::vector<std::uint8_t> parts;
  if (threads.empty()) return parts;
  parts.assign(faces.size(), 0);
  std::size_t first = 0;
  for (const ThreadAxis& thread : threads) {
    const std::size_t count = thread.flanks.size() + 2;
    if (first + count > std::numeric_limits<std::uint8_t>::max()) break;
    const AxisFrame frame(thread.point, thread.direction);
    std::vector<std::pair<std::size_t, ProfileFace>> bands;  // faces of crests and roots
    std::vector<double> distances;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (parts[f] != 0) continue;
      const Face& face = faces[f];
      const ProfileFace seen =
          profile_face(frame, Triangle{{vertices[face.v[0]], vertices[face.v[1]], vertices[face.v[2]]}});
      const std::size_t part = part_of(thread, seen);
      if (part > thread.flanks.size()) {
        bands.emplace_back(f, seen);
        distances.push_back(seen.centroid.distance);
      } else if (part > 0) {
        parts[f] = static_cast<std::uint8_t>(first + part);
      }
    }
    const double middle = between_crest_and_root(distances), period = std::abs(thread.lead) / thread.starts;
    std::complex<double> phase_sums[2];
    for (const auto& [f, face] : bands)
      phase_sums[face.centroid.distance >= middle] +=
          std::polar(face.area, kTurn * face.centroid.axial_offset(thread.lead) / period);
    for (const auto& [f, face] : bands) {
      const bool outer = face.centroid.distance >= middle;
      const auto in_band = [&](const AxisCoordinates& corner) {
        const double off = corner.axial_offset(thread.lead) / period - std::arg(phase_sums[outer]) / kTurn;
        return std::abs(off - std::round(off)) <= kOfBand;
      };
      // A face that extends beyond the band is of a plain cylinder.
      if (std::all_of(std::begin(face.corner), std::end(face.corner), in_band))
        parts[f] = static_cast<std::uint8_t>(first + thread.flanks.size() + (outer ? 2 : 1));
    }
    first += count;
  }
  return parts;
}

}  // namespace dismantle
