// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/profile_along_axis.h"

#include "dismantle/math/angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

/// Half the width of a sector, as a tangent, and some more: nothing is missed between two.
constexpr double half_width(std::size_t sectors) {
  return kTurn / 2 / static_cast<double>(sectors) * (1 + 1e-4);
}
/// Edges that are seen under no more than this angle count as radial, and nothing is missed between two edges that are
/// no further apart [rad].
constexpr double kNarrow = 1e-12;
/// Edges are followed to this share of their size before the axis.
constexpr double kAtAxis = 1e-9;

/// The angle from one to another, the short way round [rad].
double turn_between(double from, double to) {
  return std::remainder(to - from, kTurn);
}

}  // namespace

std::size_t ProfileAlongAxis::sector_of(double angle) {
  const double share = angle / kTurn - std::floor(angle / kTurn);
  return std::min(kSectors - 1, static_cast<std::size_t>(share * kSectors));
}

double ProfileAlongAxis::middle_of(std::size_t sector) {
  return (static_cast<double>(sector) + 0.5) / kSectors * kTurn;
}

/// Calls visit(sector) for the sectors from one angle to another, the short way round.
template <class Visit>
void ProfileAlongAxis::for_each_sector(double from, double to, const Visit& visit) {
  if (turn_between(from, to) < 0) std::swap(from, to);
  for (std::size_t sector = sector_of(from), last = sector_of(to);; sector = (sector + 1) % kSectors) {
    visit(sector);
    if (sector == last) return;
  }
}

ProfileAlongAxis::ProfileAlongAxis(const AxisFrame& axis, const std::vector<Triangle>& faces, bool farthest)
    : axis_(axis), farthest_(farthest) {
  for (std::size_t sector = 0; sector < kSectors; ++sector)
    middles_[sector] = {std::cos(middle_of(sector)), std::sin(middle_of(sector))};
  std::array<std::vector<GraphSegment>, kSectors> seen;
  for (const Triangle& face : faces)
    for (int i = 0; i < 3; ++i) {
      const Across from = across(face[i] - axis.point), to = across(face[(i + 1) % 3] - axis.point);
      const double begin = std::atan2(from.second, from.first), end = std::atan2(to.second, to.first);
      for_each_sector(begin, end, [&](std::size_t sector) {
        if (const auto edge = seen_in(sector, from, to)) seen[sector].push_back(*edge);
      });
    }
  for (std::size_t sector = 0; sector < kSectors; ++sector) outlines_[sector] = outline_of(std::move(seen[sector]));
}

/// The part of an edge in a sector, in the coordinates of its outline.
std::optional<GraphSegment> ProfileAlongAxis::seen_in(std::size_t sector, Across from, Across to) const {
  const InSector a = in_sector(sector, from), b = in_sector(sector, to);
  const double size = std::abs(a.ahead) + std::abs(a.aside) + std::abs(b.ahead) + std::abs(b.aside);
  double begin = 0, end = 1;
  // Cuts off the part for which a linear function is below 0.
  const auto cut = [&](double at_a, double at_b) {
    if (at_a < 0 && at_b < 0) end = -1;
    if (at_a < 0 && at_b >= 0) begin = std::max(begin, at_a / (at_a - at_b));
    if (at_a >= 0 && at_b < 0) end = std::min(end, at_a / (at_a - at_b));
  };
  const double width = half_width(kSectors);
  cut(width * a.ahead + a.aside, width * b.ahead + b.aside);
  cut(width * a.ahead - a.aside, width * b.ahead - b.aside);
  cut(a.ahead - kAtAxis * size, b.ahead - kAtAxis * size);
  if (begin > end) return std::nullopt;
  const auto point = [&](double share) {
    const double ahead = share < 1 ? a.ahead + share * (b.ahead - a.ahead) : b.ahead;
    const double aside = share < 1 ? a.aside + share * (b.aside - a.aside) : b.aside;
    return std::pair(aside / ahead, (farthest_ ? 1 : -1) / ahead);
  };
  auto low = point(begin), high = point(end);
  if (low.first > high.first) std::swap(low, high);
  if (high.first - low.first > kNarrow) return GraphSegment{low.first, low.second, high.first, high.second};
  const double outer = std::min(low.second, high.second);
  return GraphSegment{low.first - kNarrow, outer, high.first + kNarrow, outer};
}

/// The outline of what is seen in a sector.
std::vector<GraphSegment> ProfileAlongAxis::outline_of(std::vector<GraphSegment> seen) const {
  // Most is behind edges that go all through the sector.
  const double width = half_width(kSectors) * (1 - 1e-9);
  double bound = std::numeric_limits<double>::infinity();
  for (const GraphSegment& edge : seen)
    if (edge.x0 <= -width && edge.x1 >= width) bound = std::min(bound, std::max(edge.y0, edge.y1));
  const auto behind = [&](const GraphSegment& edge) { return std::min(edge.y0, edge.y1) > bound; };
  seen.erase(std::remove_if(seen.begin(), seen.end(), behind), seen.end());
  return lower_envelope(seen);
}

std::optional<double> ProfileAlongAxis::distance(double angle) const {
  const std::size_t sector = sector_of(angle);
  const double off = turn_between(middle_of(sector), angle), x = std::tan(off);
  const std::vector<GraphSegment>& outline = outlines_[sector];
  auto part =
      std::partition_point(outline.begin(), outline.end(), [&](const GraphSegment& p) { return p.x1 < x - kNarrow; });
  double lowest = std::numeric_limits<double>::infinity();
  for (; part != outline.end() && part->x0 <= x + kNarrow; ++part) lowest = std::min(lowest, part->at(x));
  if (!std::isfinite(lowest)) return std::nullopt;
  return 1 / (std::abs(lowest) * std::cos(off));
}

double ProfileAlongAxis::ratio_to_segment(Vec3 a, Vec3 b) const {
  std::optional<double> ratio;
  const auto take = [&](double found) {
    if (!ratio || beyond(found, *ratio)) ratio = found;
  };
  const double from = axis_.angle(a), to = axis_.angle(b);
  for (const auto& [angle, mine] : {std::pair(from, length(a)), std::pair(to, length(b))})
    if (const auto outline = distance(angle); outline && mine > 0) take(*outline / mine);
  const Across begin = across(a), end = across(b);
  for_each_sector(from, to, [&](std::size_t sector) {
    const InSector p = in_sector(sector, begin), q = in_sector(sector, end);
    const auto look_at = [&](double x, double y) {
      const double before = p.aside - x * p.ahead, after = q.aside - x * q.ahead;
      if (!(before * after < 0)) return;
      const double ahead = p.ahead + before / (before - after) * (q.ahead - p.ahead);
      if (ahead > 0) take(1 / (std::abs(y) * ahead));
    };
    for (const GraphSegment& part : outlines_[sector]) {
      look_at(part.x0, part.y0);
      look_at(part.x1, part.y1);
    }
  });
  return ratio.value_or(1);
}

}  // namespace dismantle
