// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/headed_shape.h"

#include "dismantle/fasteners/hexagon_drives.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dismantle {

namespace {

using Head = Fastener::Head;
using Drive = Fastener::Drive;

/// A head is wider than its shank by at least this factor, and by no more than the other.
constexpr double kMinHead = 1.12, kMaxHead = 3.2;
/// Sections of one radius differ by no more than this share.
constexpr double kSameRadius = 0.03;
/// A shank gets nowhere wider than this share beyond its usual radius.
constexpr double kShankPlay = 0.07;
/// The shank is measured over this share of its length from the tip: there is a fillet below the head.
constexpr double kBelowFillet = 0.85;
/// A shank is at least this many of its radii long.
constexpr double kShortestShank = 0.7;
/// A head is round if its smallest radius is at least this share of its largest.
constexpr double kRoundHead = 0.95;
/// Share of the ring below a head that faces the tip, from which on the head is flat below.
constexpr double kFlatBelow = 0.45;
/// A recess leaves a wall around it: it is no wider than this share of the end.
constexpr double kWidestRecess = 0.8;
/// Lobes of a recess, relative to its mean radius: of slots and crosses at least, of hexalobular sockets at least.
constexpr double kMinLobes = 0.18, kMinTorx = 0.07;

/// The sections, and which way the head is.
struct HeadRange {
  std::size_t first = 0, last = 0;  ///< Of the sections that are wider than the shank.
  bool at_end = false;              ///< True if the head is at the end of the axis.
  double shank = 0;                 ///< Usual radius of the shank [mm].
};

/// The radius that most sections have of those that are narrower than the head.
double usual_radius(const std::vector<AxialSection>& sections, double widest) {
  std::vector<double> radii;
  for (const AxialSection& s : sections)
    if (const double r = s.outer_max(); r > 0 && r * kMinHead <= widest) radii.push_back(r);
  double best = 0;
  std::size_t most = 0;
  for (const double r : radii) {
    const auto count = static_cast<std::size_t>(
        std::count_if(radii.begin(), radii.end(), [&](double x) { return std::abs(x - r) <= kSameRadius * r; }));
    if (count < most || (count == most && r <= best)) continue;
    most = count;
    best = r;
  }
  return best;
}

std::optional<HeadRange> head_range(const std::vector<AxialSection>& sections) {
  double widest = 0;
  for (const AxialSection& s : sections) widest = std::max(widest, s.outer_max());
  HeadRange range;
  range.shank = usual_radius(sections, widest);
  if (!(range.shank > 0) || widest > kMaxHead * range.shank) return std::nullopt;
  const auto is_wide = [&](const AxialSection& s) { return s.outer_max() > kMinHead * range.shank; };
  const auto first = std::find_if(sections.begin(), sections.end(), is_wide);
  const auto last = std::find_if(sections.rbegin(), sections.rend(), is_wide).base() - 1;
  range.first = static_cast<std::size_t>(first - sections.begin());
  range.last = static_cast<std::size_t>(last - sections.begin());
  const std::size_t before = range.first, after = sections.size() - 1 - range.last;
  range.at_end = before > after;
  // Beyond the head there is only the top of its dome.
  if (std::min(before, after) > 1 + (range.last - range.first) / 3 || std::max(before, after) < 3) return std::nullopt;
  // The end of a cone, and a fillet, are between head and shank.
  const auto is_shank = [&](std::size_t i) { return sections[i].outer_max() <= (1 + kShankPlay) * range.shank; };
  std::size_t neck = range.at_end ? range.first : range.last;
  while (!is_shank(neck) && neck > 0 && neck + 1 < sections.size()) neck = range.at_end ? neck - 1 : neck + 1;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (range.at_end ? i < neck : i > neck) {
      if (!is_shank(i)) return std::nullopt;
      ++beyond;
    }
    if (i >= range.first && i <= range.last && !is_wide(sections[i])) return std::nullopt;
  }
  // A chamfer or a rounded end is no shank.
  const double step = sections[1].along - sections[0].along;
  if (static_cast<double>(beyond) * step < kShortestShank * range.shank) return std::nullopt;
  return range;
}

/// Where the ring below the head is, and how much of it faces the tip.
struct Underside {
  double along = 0;  ///< Position along the axis, from the frame's point [mm].
  double share = 0;  ///< Of the area between shank and head.
};

Underside underside_of(const TriangleMesh& mesh, const AxisFrame& frame, double sign, const HeadRange& range,
                       double head_radius) {
  struct Level {
    double along, area;
  };
  std::vector<Level> levels;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle t = mesh.triangle(f);
    const Vec3 normal = normal_unscaled(t);
    const double area = length(normal) / 2;
    if (!(area > 0) || -sign * dot(normal, frame.direction) < 0.995 * 2 * area) continue;
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
    double reach = 0;
    for (int i = 0; i < 3; ++i) reach = std::max(reach, length(frame.across(t[i])));
    if (reach > 1.03 * range.shank) levels.push_back({frame.along(middle), area});
  }
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.along < b.along; });
  Underside best;
  double best_area = 0;
  for (std::size_t i = 0; i < levels.size();) {
    std::size_t next = i;
    double area = 0;
    for (; next < levels.size() && levels[next].along - levels[i].along <= 0.02 * range.shank; ++next)
      area += levels[next].area;
    if (area > best_area) {
      best_area = area;
      best.along = levels[i].along;
    }
    i = next;
  }
  const double ring = kTurn / 2 * (head_radius * head_radius - range.shank * range.shank);
  best.share = ring > 0 ? best_area / ring : 0;
  return best;
}

Head form_of(const std::vector<AxialSection>& sections, const HeadRange& range, double widest, bool is_hexagon,
             bool is_flat) {
  if (is_hexagon) return Head::Hexagon;
  std::size_t round = 0, wide = 0, count = 0;
  for (std::size_t i = range.first; i <= range.last; ++i) {
    const AxialSection& s = sections[i];
    ++count;
    wide += s.outer_max() >= 0.96 * widest;
    round += s.outer_min() >= kRoundHead * s.outer_max() || s.misses() > 0;
  }
  if (2 * round < count) return Head::Other;
  if (!is_flat) return Head::Countersunk;
  return 10 * wide >= 7 * count ? Head::Cylinder : Head::Button;
}

/// The outer hexagon of a head.
double hexagon_of(const TriangleMesh& mesh, const FastenerAxis& axis, double shank) {
  double best = 0;
  for (const HexagonDrive& drive : hexagon_drives(mesh, {axis.frame.point, axis.frame.direction, 0}))
    if (drive.kind == HexagonDrive::Kind::Head && drive.across_flats > 2 * kMinHead * shank * 0.9)
      best = std::max(best, drive.across_flats);
  return best;
}

}  // namespace

DriveRecess drive_recess(const TriangleMesh& mesh, const FastenerAxis& axis, const std::vector<AxialSection>& sections,
                         AxisEnd end) {
  std::vector<const AxialSection*> in_recess;
  const std::size_t count = sections.size();
  for (std::size_t i = 0; i < count; ++i) {
    const AxialSection& s = sections[end == AxisEnd::End ? count - 1 - i : i];
    if (!s.axis_is_empty()) break;
    in_recess.push_back(&s);
  }
  if (in_recess.empty() || in_recess.size() == count) return {};
  double reach = 0;
  for (const AxialSection* s : in_recess) reach = std::max(reach, s->outer_max());
  for (const HexagonDrive& drive : hexagon_drives(mesh, {axis.frame.point, axis.frame.direction, 0}))
    if (drive.kind == HexagonDrive::Kind::Socket && drive.across_flats < kWidestRecess * 2 * reach) {
      // The socket may be in the other end.
      for (const AxialSection* s : in_recess)
        if (s->hole_max() < 0.62 * drive.across_flats && s->hole_min() > 0.48 * drive.across_flats)
          return {Drive::HexSocket, drive.across_flats};
    }
  DriveRecess best;
  double strongest = 0;
  for (const AxialSection* s : in_recess) {
    std::array<double, kSectionRays> hole = s->hole;
    for (std::size_t k = 0; k < kSectionRays; ++k)
      if (s->hits[k] == 0) hole[k] = reach;
    const double two = lobe_amplitude(hole, 2), four = lobe_amplitude(hole, 4), six = lobe_amplitude(hole, 6);
    const double largest = *std::max_element(hole.begin(), hole.end());
    const double smallest = *std::min_element(hole.begin(), hole.end());
    const double strength = std::max({two, four, six});
    if (strength <= strongest) continue;
    if (two == strength && two > kMinLobes) {
      best = {Drive::Slot, 0};
    } else if (four == strength && four > kMinLobes) {
      best = {Drive::Cross, 0};
    } else if (six == strength && six > kMinTorx && largest > 1.22 * smallest && smallest > 0 &&
               largest < kWidestRecess * reach) {
      best = {Drive::Torx, 2 * largest};
    } else {
      continue;
    }
    strongest = strength;
  }
  return best;
}

std::optional<HeadedShape> headed_shape(const TriangleMesh& mesh, const FastenerAxis& axis,
                                        const std::vector<AxialSection>& sections) {
  if (std::all_of(sections.begin(), sections.end(), [](const AxialSection& s) { return s.axis_is_empty(); }))
    return std::nullopt;
  const std::optional<HeadRange> range = head_range(sections);
  if (!range) return std::nullopt;
  // The shank is solid.
  std::size_t hollow = 0, shank = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (i >= range->first && i <= range->last) continue;
    ++shank;
    hollow += sections[i].axis_is_empty();
  }
  if (2 * hollow > shank) return std::nullopt;

  HeadedShape shape;
  const double sign = range->at_end ? 1 : -1;
  shape.axis = sign * axis.frame.direction;
  shape.head_radius = axis.radius;
  shape.total_length = axis.length();
  const Underside below = underside_of(mesh, axis.frame, sign, *range, axis.radius);
  const double step = axis.length() / static_cast<double>(sections.size());
  const double rough = range->at_end ? sections[range->first].along - step / 2 : sections[range->last].along + step / 2;
  const bool is_flat = below.share > kFlatBelow && std::abs(below.along - rough) < 3 * step + 0.1 * axis.radius;
  const double bottom = is_flat ? below.along : rough;
  shape.shank_length = range->at_end ? bottom - axis.begin : axis.end - bottom;
  shape.head_height = shape.total_length - shape.shank_length;
  shape.shank_radius = 0;
  for (const Vec3& p : mesh.vertices) {
    const double from_tip = range->at_end ? axis.frame.along(p) - axis.begin : axis.end - axis.frame.along(p);
    const double radius = length(axis.frame.across(p));
    if (from_tip < kBelowFillet * shape.shank_length && radius <= (1 + kShankPlay) * range->shank)
      shape.shank_radius = std::max(shape.shank_radius, radius);
  }
  if (!(shape.shank_radius > 0)) shape.shank_radius = range->shank;
  shape.across_flats = hexagon_of(mesh, axis, range->shank);
  shape.head = form_of(sections, *range, axis.radius, shape.across_flats > 1.6 * axis.radius, is_flat);
  if (shape.head != Head::Hexagon) shape.across_flats = 0;
  shape.recess = drive_recess(mesh, axis, sections, range->at_end ? AxisEnd::End : AxisEnd::Begin);
  return shape;
}

}  // namespace dismantle
