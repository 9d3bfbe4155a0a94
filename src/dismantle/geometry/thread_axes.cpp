// SPDX-License-Identifier: Apache-2.0
#include "dismantle/geometry/thread_axes.h"

#include "dismantle/geometry/axis_frame.h"
#include "dismantle/geometry/thread_fit.h"

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

constexpr double kTurn = 6.283185307179586;
/// An edge is along a helix where its ends' distances from the axis differ by no more than this share of them,
constexpr double kSameDistance = 2e-3;
/// the angle between them is between these [rad],
constexpr double kLeastAngle = 1e-3, kMostAngle = 1.3;
/// and the lead that it has is between these shares of the distance.
constexpr double kLeastLead = 0.03, kMostLead = 6;
/// Leads agree that differ by no more than this share.
constexpr double kSameLead = 1e-3;
/// Threads mate whose leads differ by no more than this share, and whose axes are no more at an angle than this [sine],
/// and no further apart than this share of the lead.
constexpr double kMatingLead = 5e-3, kMatingSine = 0.02, kMatingShare = 0.25;
/// So many axes of a mesh are looked at, those with the longest turns,
constexpr std::size_t kMostAxes = 16;
/// and so many leads of each, those with the longest edges [rad],
constexpr std::size_t kMostLeads = 3;
/// if these are at least a turn long, and this share of all such edges.
constexpr double kLeastTurn = kTurn, kLeastShare = 0.05;
/// No more than so many edges are looked at, of all axes together: an even choice of them.
constexpr std::size_t kMostEdges = 4'000'000;
constexpr int kMostStarts = 4;
/// Another lead or number of starts is taken where flanks have so many times the area with it.
constexpr double kMuchMore = 1.5;
/// Outward normals in the profile are sorted into so many directions; a flank takes no more than this many of them.
constexpr int kDirections = 72;
constexpr int kMostOfFlank = 6;
/// What has less than this share of the area of the largest flank is none.
constexpr double kLeastOfLargest = 0.1;
/// The least share of the normal along the axis that a flank has.
constexpr double kLeastLift = 0.15;
/// How well the faces of a flank agree about its place: 1 for all at one, 0 for all over the profile.
constexpr double kLeastAgreement = 0.75;
/// How little they agree about the angle around the axis.
constexpr double kMostOneSided = 0.3;
/// Faces of which the centroid is no further off a flank, in profiles, tell where it is.
constexpr double kNearPlace = 0.12;
/// A face is of a flank where its normal is no further from the flank's [cosine], and its corners are no further off
/// it, in profiles.
constexpr double kOfFlank = 0.85, kOfPlace = 0.02;
/// And of a crest or a root where the lifts of its corners are no further from theirs, in profiles.
constexpr double kOfBand = 0.25;

/// A mesh without edges along helices may have a thread if it has so many faces. Its fit is made with no more than so
/// many of the curved places,
constexpr std::size_t kFewestFaces = 400, kMostSamples = 40'000;
/// its lead sought no further from the fit's than this share of it, in steps for which so many parts of a turn add up
/// along the thread; with no more than so many faces at first, and then with more, so often a third closer.
constexpr double kLeadRange = 0.12, kLeadStep = 0.05;
constexpr std::size_t kMostScanned = 2000, kMostFitted = 10'000;
constexpr int kCloser = 20;

/// A place about an axis.
struct AxisPlace {
  double distance = 0, angle = 0, along = 0;
  double lift(double lead) const { return along - lead * angle / kTurn; }
};

AxisPlace place_of(const AxisFrame& frame, Vec3 p) {
  const Vec3 across = frame.across(p);
  return {length(across), frame.angle(across), frame.along(p)};
}

/// A face about an axis.
struct ProfileFace {
  AxisPlace centroid, corner[3];
  ProfileDirection normal;  ///< Unit, or zero for one that faces around the axis.
  double area = 0;
};

ProfileFace profile_face(const AxisFrame& frame, const Triangle& t) {
  ProfileFace face;
  const Vec3 normal = normal_unscaled(t), centroid = (t[0] + t[1] + t[2]) / 3;
  face.centroid = place_of(frame, centroid);
  for (int i = 0; i < 3; ++i) face.corner[i] = place_of(frame, t[i]);
  face.area = length(normal) / 2;
  if (!(face.area > 0) || !(face.centroid.distance > 0)) return face;
  const double radial = dot(normal, frame.across(centroid)) / face.centroid.distance;
  const double lift = dot(normal, frame.direction);
  const double size = std::hypot(radial, lift);
  face.normal = size > face.area ? ProfileDirection{radial / size, lift / size} : ProfileDirection{0, 0};
  return face;
}

/// Edges along helices of one lead.
struct Helices {
  double turn = 0;  ///< The sum of their angles [rad].
  double lead = 0;  ///< The same, each times its lead; in the end the mean lead.
  /// Where they are.
  double begin = std::numeric_limits<double>::infinity(), end = -begin, least = begin, most = 0;

  void add(const Helices& other) {
    turn += other.turn;
    lead += other.lead;
    begin = std::min(begin, other.begin);
    end = std::max(end, other.end);
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
  /// Whether a face may be of the thread that these are edges of.
  bool reach(const ProfileFace& face) const {
    const double play = std::abs(lead) / 4;
    const AxisPlace& at = face.centroid;
    return at.along >= begin - play && at.along <= end + play && at.distance >= least - play &&
           at.distance <= most + play;
  }
};

/// The edges of the mesh along helices about the axis by their leads, those of the longest edges first.
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
      if (!(std::abs(angle) >= kLeastAngle && std::abs(angle) <= kMostAngle)) continue;
      const double lead = kTurn * rise / angle, size = std::abs(lead);
      if (!(size >= kLeastLead * distance && size <= kMostLead * distance)) continue;
      const auto place = static_cast<std::int64_t>(std::floor(std::log(size) * cell_count));
      const double turn = std::abs(angle) * static_cast<double>(stride);
      const double low = frame.along(vertices[v]), high = low + rise;
      all += turn;
      cells[2 * place + (lead < 0 ? 1 : 0)].add({turn, turn * lead, std::min(low, high), std::max(low, high),
                                                 std::min(distance, other), std::max(distance, other)});
    }
  std::vector<Helices> sums, found;
  for (const auto& [cell, votes] : cells) {
    Helices sum = votes;
    if (const auto next = cells.find(cell + 2); next != cells.end()) sum.add(next->second);
    if (!(sum.turn >= std::max(kLeastTurn, kLeastShare * all))) continue;
    sum.lead /= sum.turn;
    sums.push_back(sum);
  }
  std::stable_sort(sums.begin(), sums.end(), [](const Helices& x, const Helices& y) { return x.turn > y.turn; });
  for (const Helices& sum : sums) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const Helices& other) {
      return std::abs(other.lead - sum.lead) <= 3 * kSameLead * std::abs(sum.lead);
    });
    if (!known && found.size() < kMostLeads) found.push_back(sum);
  }
  return found;
}

/// Faces whose outward normals in the profile are alike.
struct Direction {
  double area = 0, radial = 0, lift = 0;  // sums
  std::complex<double> place, angle;      // where they are in the profile and around the axis
  std::vector<const ProfileFace*> faces;
  ProfileDirection normal() const {
    const double size = std::hypot(radial, lift);
    return {radial / size, lift / size};
  }
};

using Directions = std::array<Direction, kDirections>;

std::size_t direction_of(ProfileDirection normal) {
  const double turned = std::atan2(normal.lift, normal.radial) / kTurn + 0.5;
  return std::min<std::size_t>(kDirections - 1, static_cast<std::size_t>(turned * kDirections));
}

double along(ProfileDirection normal, const AxisPlace& at, double lead) {
  return normal.radial * at.distance + normal.lift * at.lift(lead);
}

/// How far the place is off the flank, in profiles: between minus and plus a half.
double profiles_off(const ThreadAxis::Flank& flank, const AxisPlace& at, double lead, double period) {
  const double off = (along(flank.normal, at, lead) - flank.place) / (flank.normal.lift * period);
  return off - std::round(off);
}

/// The turn that a place along a normal is in the profile.
std::complex<double> phase(ProfileDirection normal, double place, double period) {
  return std::polar(1.0, kTurn * place / (normal.lift * period));
}

bool may_be_flank(const ProfileFace& face) {
  return std::abs(face.normal.lift) >= kLeastLift;
}

/// The thread that the faces have with some lead; the more of their area agrees about it the better.
struct Profile {
  ThreadAxis thread;
  double area = 0;
};

/// The runs of directions in which the faces agree about their place.
std::vector<std::vector<std::size_t>> agreeing(const Directions& directions) {
  std::vector<std::vector<std::size_t>> runs;
  double all = 0;
  for (const Direction& d : directions) all += d.area;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const Direction& d = directions[i];
    const bool agrees = d.area > 1e-3 * all && std::abs(d.place) >= kLeastAgreement * d.area &&
                        std::abs(d.angle) <= kMostOneSided * d.area;
    if (!agrees) continue;
    const bool goes_on = !runs.empty() && runs.back().back() + 1 == i && runs.back().size() < kMostOfFlank &&
                         directions[i - 1].lift * d.lift > 0;
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
  double most = 0;
  for (const std::vector<std::size_t>& run : runs) most = std::max(most, area(run));
  std::erase_if(runs, [&](const std::vector<std::size_t>& run) { return area(run) < kLeastOfLargest * most; });
  return runs;
}

/// Whether all its corners are, nearly.
bool on_flank(const ThreadAxis::Flank& flank, const ProfileFace& face, double lead, double period) {
  return std::all_of(std::begin(face.corner), std::end(face.corner), [&](const AxisPlace& corner) {
    return std::abs(profiles_off(flank, corner, lead, period)) <= kOfPlace;
  });
}

/// The line in the profile that the corners of the flank's faces are nearest to, for the one that is roughly known.
ThreadAxis::Flank fitted(const ThreadAxis::Flank& rough, const std::vector<const ProfileFace*>& faces, double lead,
                         double period) {
  // About the rough line: how far off it, and how far along it.
  double sum_off = 0, sum_far = 0, off_off = 0, far_far = 0, off_far = 0, count = 0;
  for (const ProfileFace* face : faces) {
    if (std::abs(profiles_off(rough, face->centroid, lead, period)) > kNearPlace) continue;
    for (const AxisPlace& at : face->corner) {
      const double off = profiles_off(rough, at, lead, period) * rough.normal.lift * period;
      // On the line it is where its lift is: off = radial * distance + lift * (lift - that of the period) - place.
      const double lift = (off + rough.place - rough.normal.radial * at.distance) / rough.normal.lift;
      const double far = rough.normal.lift * at.distance - rough.normal.radial * lift;
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
  flank.normal = {cosine * n.radial - sine * n.lift, cosine * n.lift + sine * n.radial};
  flank.place = cosine * (rough.place + mean_off) - sine * mean_far;
  return flank;
}

/// @param faces that may be flanks
Directions by_direction(const std::vector<ProfileFace>& faces, double lead, double period) {
  Directions directions;
  for (const ProfileFace& face : faces) {
    Direction& d = directions[direction_of(face.normal)];
    d.faces.push_back(&face);
    d.area += face.area;
    d.radial += face.area * face.normal.radial;
    d.lift += face.area * face.normal.lift;
  }
  for (Direction& d : directions)
    for (const ProfileFace* face : d.faces) {
      d.place += face->area * phase(d.normal(), along(d.normal(), face->centroid, lead), period);
      d.angle += std::polar(face->area, face->centroid.angle);
    }
  return directions;
}

/// The directions of a run taken together.
Direction sum_of(const Directions& directions, const std::vector<std::size_t>& run) {
  Direction sum;
  for (const std::size_t i : run) {
    const Direction& d = directions[i];
    sum.area += std::abs(d.place);
    sum.radial += d.radial;
    sum.lift += d.lift;
    sum.faces.insert(sum.faces.end(), d.faces.begin(), d.faces.end());
  }
  return sum;
}

/// The flank that the faces of one direction are of.
ThreadAxis::Flank flank_of(const Direction& d, double lead, double period) {
  ThreadAxis::Flank flank{d.normal(), 0};
  std::complex<double> place;
  for (const ProfileFace* face : d.faces)
    place += face->area * phase(flank.normal, along(flank.normal, face->centroid, lead), period);
  flank.place = std::arg(place) / kTurn * flank.normal.lift * period;
  return fitted(flank, d.faces, lead, period);
}

/// Makes the thread as long and as deep as the faces on its flank.
void extend(ThreadAxis& thread, const ThreadAxis::Flank& flank, const std::vector<const ProfileFace*>& faces,
            double period) {
  for (const ProfileFace* face : faces) {
    if (!on_flank(flank, *face, thread.lead, period)) continue;
    for (const AxisPlace& corner : face->corner) {
      thread.begin = std::min(thread.begin, corner.along);
      thread.end = std::max(thread.end, corner.along);
      thread.least = std::min(thread.least, corner.distance);
      thread.most = std::max(thread.most, corner.distance);
    }
  }
}

/// @param faces that may be flanks
std::optional<Profile> profile_of(const std::vector<ProfileFace>& faces, const RoundAxis& axis, double lead,
                                  int starts) {
  const double period = std::abs(lead) / starts;
  const Directions directions = by_direction(faces, lead, period);
  Profile found;
  ThreadAxis& thread = found.thread;
  thread.point = axis.point;
  thread.direction = axis.direction;
  thread.lead = lead;
  thread.starts = starts;
  thread.begin = thread.least = std::numeric_limits<double>::infinity();
  thread.end = -thread.begin;
  bool leads_on = false, leads_back = false;
  for (const std::vector<std::size_t>& run : agreeing(directions)) {
    const Direction sum = sum_of(directions, run);
    const ThreadAxis::Flank flank = flank_of(sum, lead, period);
    extend(thread, flank, sum.faces, period);
    thread.flanks.push_back(flank);
    found.area += sum.area;
    (flank.normal.lift > 0 ? leads_on : leads_back) = true;
  }
  if (!leads_on || !leads_back || thread.least > thread.most) return std::nullopt;
  return found;
}

std::optional<Profile> best_profile(Span<const Vec3> vertices, Span<const Face> faces, const RoundAxis& axis,
                                    std::size_t stride) {
  const AxisFrame frame(axis.point, axis.direction);
  std::optional<Profile> best;
  std::vector<ProfileFace> all;
  for (const Helices& edges : helices(frame, vertices, faces, stride)) {
    if (all.empty())
      for (const Face& f : faces)
        all.push_back(profile_face(frame, Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}}));
    std::vector<ProfileFace> near;
    for (const ProfileFace& face : all)
      if (may_be_flank(face) && edges.reach(face)) near.push_back(face);
    for (int starts = 1; starts <= kMostStarts; ++starts) {
      std::optional<Profile> found = profile_of(near, axis, edges.lead, starts);
      if (found && (!best || found->area > kMuchMore * best->area)) best = std::move(found);
    }
  }
  return best;
}

/// How much area of possible flanks agrees about its place in the profile with one lead or another.
class Agreement {
 public:
  /// @param count of the faces at most that are looked at, an even choice
  Agreement(const std::vector<ProfileFace>& faces, std::size_t count) {
    const std::size_t stride = 1 + faces.size() / count;
    Directions directions;
    for (const ProfileFace& face : faces) {
      Direction& d = directions[direction_of(face.normal)];
      d.radial += face.area * face.normal.radial;
      d.lift += face.area * face.normal.lift;
    }
    for (std::size_t i = 0; i < faces.size(); i += stride) {
      const ProfileFace& face = faces[i];
      const std::size_t direction = direction_of(face.normal);
      const ProfileDirection normal = directions[direction].normal();
      seen_.push_back({direction, normal.radial / normal.lift * face.centroid.distance + face.centroid.along,
                       std::polar(face.area, -face.centroid.angle)});
    }
  }

  double area(double lead) const {
    std::array<std::complex<double>, kDirections> sums{};
    for (const Seen& s : seen_) sums[s.direction] += s.turned * std::polar(1.0, kTurn * s.place / lead);
    double area = 0;
    for (const std::complex<double>& sum : sums) area += std::abs(sum);
    return area;
  }

 private:
  struct Seen {
    std::size_t direction;
    double place;                 // where its plane of the profile meets the axis, angle 0 [mm]
    std::complex<double> turned;  // its area, turned back by its angle
  };
  std::vector<Seen> seen_;
};

/// The lead near a rough one with which the most area agrees. The peak is narrow: few faces tell about where it is.
/// @param turns how many turns the thread has
double sharpest_lead(const std::vector<ProfileFace>& faces, double rough, double turns) {
  const Agreement few(faces, kMostScanned), many(faces, kMostFitted);
  const double step = kLeadStep / std::max(1.0, turns);
  double best = rough, most = 0;
  for (double off = -kLeadRange; off <= kLeadRange; off += step) {
    const double found = few.area(rough * (1 + off));
    if (found <= most) continue;
    most = found;
    best = rough * (1 + off);
  }
  double low = best * (1 - step), high = best * (1 + step);
  for (int round = 0; round < kCloser; ++round) {
    const double x = low + (high - low) / 3, y = high - (high - low) / 3;
    if (many.area(x) < many.area(y)) {
      low = x;
    } else {
      high = y;
    }
  }
  return (low + high) / 2;
}

/// The thread of a mesh that was cut anew, which has no edges along helices: its surface tells the axis, and about how
/// far it leads.
std::optional<Profile> recut_profile(Span<const Vec3> vertices, Span<const Face> faces) {
  if (faces.size() < kFewestFaces) return std::nullopt;
  const std::optional<ThreadAxis> rough = fit_thread(curved_samples(vertices, faces, kMostSamples));
  if (!rough) return std::nullopt;
  const AxisFrame frame(rough->point, rough->direction);
  std::vector<ProfileFace> near;
  for (const Face& f : faces) {
    const ProfileFace face = profile_face(frame, Triangle{{vertices[f.v[0]], vertices[f.v[1]], vertices[f.v[2]]}});
    const AxisPlace& at = face.centroid;
    if (may_be_flank(face) && at.along >= rough->begin && at.along <= rough->end && at.distance <= rough->most)
      near.push_back(face);
  }
  const double lead = sharpest_lead(near, rough->lead, (rough->end - rough->begin) / std::abs(rough->lead));
  std::optional<Profile> best;
  for (int starts = 1; starts <= kMostStarts; ++starts) {
    std::optional<Profile> found = profile_of(near, {rough->point, rough->direction}, lead, starts);
    if (found && (!best || found->area > kMuchMore * best->area)) best = std::move(found);
  }
  return best;
}

/// The distance from the axis that parts those of crests from those of roots: as far from the mean of the ones as of
/// the others.
double between_crest_and_root(const std::vector<double>& distances) {
  const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
  if (least == distances.end()) return 0;
  double low = *least, high = *most;
  for (int round = 0; round < 4; ++round) {
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
  const double play = (thread.most - thread.least) / 4;
  const AxisPlace& at = face.centroid;
  if (at.along < thread.begin - period || at.along > thread.end + period) return 0;
  if (at.distance < thread.least - play || at.distance > thread.most + play) return 0;
  for (std::size_t i = 0; i < thread.flanks.size(); ++i) {
    const ThreadAxis::Flank& flank = thread.flanks[i];
    if (flank.normal.radial * face.normal.radial + flank.normal.lift * face.normal.lift < kOfFlank) continue;
    if (on_flank(flank, face, thread.lead, period)) return 1 + i;
  }
  // Crests and roots face the way that both flanks lean to; those of a square thread may face either.
  const double radial = face.normal.radial, leaning = thread.leaning();
  return std::abs(radial) < kOfFlank || radial * leaning < 0 ? 0 : thread.flanks.size() + 1;
}

}  // namespace

std::vector<ThreadAxis> thread_axes(Span<const Vec3> vertices, Span<const Face> faces, Span<const RoundAxis> axes) {
  std::vector<ThreadAxis> threads;
  const std::size_t count = std::min(axes.size(), kMostAxes), stride = 1 + 3 * faces.size() * count / kMostEdges;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::optional<Profile> profile = best_profile(vertices, faces, axes[i], stride))
      threads.push_back(profile->thread);
  if (threads.empty())
    if (const std::optional<Profile> profile = recut_profile(vertices, faces)) threads.push_back(profile->thread);
  return threads;
}

bool threads_mate(const ThreadAxis& x, const ThreadAxis& y) {
  const double lead = std::min(std::abs(x.lead), std::abs(y.lead));
  return x.leaning() * y.leaning() < 0 && x.starts == y.starts && std::abs(x.lead - y.lead) <= kMatingLead * lead &&
         length(cross(x.direction, y.direction)) <= kMatingSine &&
         length(AxisFrame(y.point, y.direction).across(x.point)) <= kMatingShare * lead;
}

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
    std::vector<std::pair<std::size_t, ProfileFace>> round;  // faces of crests and roots
    std::vector<double> distances;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (parts[f] != 0) continue;
      const Face& face = faces[f];
      const ProfileFace seen =
          profile_face(frame, Triangle{{vertices[face.v[0]], vertices[face.v[1]], vertices[face.v[2]]}});
      const std::size_t part = part_of(thread, seen);
      if (part > thread.flanks.size()) {
        round.emplace_back(f, seen);
        distances.push_back(seen.centroid.distance);
      } else if (part > 0) {
        parts[f] = static_cast<std::uint8_t>(first + part);
      }
    }
    const double middle = between_crest_and_root(distances), period = std::abs(thread.lead) / thread.starts;
    std::complex<double> lifts[2];
    for (const auto& [f, face] : round)
      lifts[face.centroid.distance >= middle] +=
          std::polar(face.area, kTurn * face.centroid.lift(thread.lead) / period);
    for (const auto& [f, face] : round) {
      const bool outer = face.centroid.distance >= middle;
      const auto in_band = [&](const AxisPlace& corner) {
        const double off = corner.lift(thread.lead) / period - std::arg(lifts[outer]) / kTurn;
        return std::abs(off - std::round(off)) <= kOfBand;
      };
      // What goes on as a plain cylinder is none.
      if (std::all_of(std::begin(face.corner), std::end(face.corner), in_band))
        parts[f] = static_cast<std::uint8_t>(first + thread.flanks.size() + (outer ? 2 : 1));
    }
    first += count;
  }
  return parts;
}

}  // namespace dismantle
