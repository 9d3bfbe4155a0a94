// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/turning_retraction.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/math/angle.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace dismantle {

namespace {

/// Facets of cylinders have normals across the axis to within this sine.
constexpr double kAcross = 0.1;
/// Two axes are one if they are no further apart than so many tolerances where the components meet, and their
/// directions differ by no more than this sine.
constexpr double kSameAxis = 1, kSameDirection = 1e-4;
/// Two corners of a facet of a cylinder, the third of which may be on a chord, are this nearly on one circle, and it is
/// no nearer to the axis than this share of the radius.
constexpr double kOnCircle = 0.999, kSmallestFacet = 0.965;

/// Facets count as a cylinder if they cover at least this share of a circle, which is divided into so many parts: the
/// ends of a thin plate lie on a circle, too.
constexpr double kShareOfCircle = 0.3;
constexpr std::size_t kParts = 72;

/// The tangents of the angles between the parts of a quarter of a circle.
constexpr std::size_t kQuarter = kParts / 4;
std::array<double, kQuarter - 1> tangents_of_parts() {
  std::array<double, kQuarter - 1> tangents;
  for (std::size_t k = 0; k < tangents.size(); ++k)
    tangents[k] = std::tan(static_cast<double>(k + 1) * kTurn / static_cast<double>(kParts));
  return tangents;
}

class Turning {
 public:
  Turning(const SolidTree& own, const SolidTree& other, double depth, double tolerance)
      : own_(own),
        other_(other),
        depth_(depth),
        tolerance_(tolerance),
        found_{std::vector<double>(own.faces.size()), 0} {}

  TurningRetraction find() {
    if (!own_.revolution || !other_.revolution) return std::move(found_);
    for (const RevolutionAxis& mine : own_.revolution->axes())
      for (const RevolutionAxis& theirs : other_.revolution->axes())
        if (same_axis(mine, theirs, kSameDirection, kSameAxis * tolerance_))
          allow_turning(AxisFrame(mine.point, mine.direction));
    return std::move(found_);
  }

 private:
  /// A face in coordinates about an axis.
  struct Facet {
    double along[3];                   // of its corners [mm]
    double nearest = 0, farthest = 0;  // distances from the axis [mm]
    double on_circle = 0;              // that of the second farthest corner [mm]
    double sagitta = 0;                // of the arc that the face spans about the axis [mm]
    bool is_shaft = false;             // its normal points away from the axis

    Facet(const AxisFrame& axis, const Triangle& t, const Vec3& normal) {
      Vec3 across[3];
      for (int i = 0; i < 3; ++i) {
        across[i] = axis.across(t[i]);
        along[i] = axis.along(t[i]);
      }
      double corners[] = {length(across[0]), length(across[1]), length(across[2])};
      std::sort(std::begin(corners), std::end(corners));
      on_circle = corners[1];
      nearest = farthest = corners[2];
      double cosine = 1;  // of the angle that it spans
      for (int i = 0; i < 3; ++i) {
        const Vec3 &from = across[i], &to = across[(i + 1) % 3];
        nearest = std::min(nearest, AxisFrame::distance_of_segment(from, to));
        cosine = std::min(cosine, dot(from, to) / (length(from) * length(to)));
      }
      sagitta = farthest * (1 - std::sqrt(std::max(0.0, (1 + cosine) / 2)));
      is_shaft = dot(normal, across[0]) > 0;
    }
  };

  /// Facets of one cylinder in coordinates about its axis.
  struct Cylinder {
    std::vector<std::uint32_t> faces;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;  // from the axis [mm]
    double begin = nearest, end = -nearest;                                  // along the axis [mm]
    double sagitta = 0;                                                      // the largest one of a facet [mm]

    void add(std::uint32_t face, const Facet& facet) {
      faces.push_back(face);
      nearest = std::min(nearest, facet.nearest);
      farthest = std::max(farthest, facet.farthest);
      sagitta = std::max(sagitta, facet.sagitta);
      for (const double at : facet.along) {
        begin = std::min(begin, at);
        end = std::max(end, at);
      }
    }
    /// True if the facets cover enough of the circle. Found out when it is first asked, as most cylinders never are.
    bool is_round(const AxisFrame& axis, const SolidTree& tree) const {
      if (!round_) {
        std::bitset<kParts> seen;
        for (const std::uint32_t f : faces) see(axis, tree.triangle(f), seen);
        round_ = static_cast<double>(seen.count()) >= kShareOfCircle * kParts;
      }
      return *round_;
    }

   private:
    /// Marks the parts of the circle that a facet covers.
    static void see(const AxisFrame& axis, const Triangle& facet, std::bitset<kParts>& seen) {
      Vec3 across[3];
      std::size_t parts[3];
      for (int i = 0; i < 3; ++i) {
        across[i] = axis.across(facet[i]);
        parts[i] = part_of(axis, across[i]);
        seen.set(parts[i]);
      }
      for (int i = 0; i < 3; ++i) {
        // Most facets have their corners in one part, or in two beside each other.
        const int next = (i + 1) % 3;
        const std::size_t apart = parts[i] > parts[next] ? parts[i] - parts[next] : parts[next] - parts[i];
        if (apart <= 1 || apart >= kParts - 1) continue;
        constexpr int kSteps = 8;  // along the chord, the short way round
        for (int k = 1; k < kSteps; ++k) {
          const double share = static_cast<double>(k) / kSteps;
          seen.set(part_of(axis, (1 - share) * across[i] + share * across[next]));
        }
      }
    }
    /// The part of the circle in whose direction a point lies.
    static std::size_t part_of(const AxisFrame& axis, const Vec3& p) {
      static const std::array<double, kQuarter - 1> kTangents = tangents_of_parts();
      const double x = dot(p, axis.first), y = dot(p, axis.second);
      const std::size_t quarter = y >= 0 ? (x > 0 ? 0 : 1) : (x < 0 ? 2 : 3);
      const bool even = quarter % 2 == 0;
      const double along = std::abs(even ? x : y), across = std::abs(even ? y : x);  // from where the quarter begins
      std::size_t part = 0;
      for (const double tangent : kTangents) part += across >= tangent * along;
      return quarter * kQuarter + part;
    }

    mutable std::optional<bool> round_;
  };
  /// By the radius in tolerances, negative for a bore.
  using Cylinders = std::map<double, Cylinder>;

  Cylinders cylinders_about(const AxisFrame& axis, const SolidTree& tree) const {
    Cylinders cylinders;
    std::vector<std::pair<std::uint32_t, Facet>> others;  // that may be parts of facets
    for (std::uint32_t f = 0; f < tree.faces.size(); ++f) {
      const Triangle t = tree.triangle(f);
      const Vec3 normal = normalized(normal_unscaled(t));
      if (std::abs(dot(normal, axis.direction)) > kAcross) continue;
      const Facet facet(axis, t, normal);
      if (facet.nearest < kSmallestFacet * facet.farthest) continue;
      if (facet.on_circle < kOnCircle * facet.farthest) {
        others.emplace_back(f, facet);
        continue;
      }
      const double radius = std::round(facet.farthest / tolerance_);
      cylinders[facet.is_shaft ? radius : -radius].add(f, facet);
    }
    for (auto& [radius, cylinder] : cylinders) add_parts(axis, tree, others, radius > 0, cylinder);
    return cylinders;
  }

  /// Adds faces between the chords and the circle of a cylinder that share corners with its facets.
  static void add_parts(const AxisFrame& axis, const SolidTree& tree,
                        std::vector<std::pair<std::uint32_t, Facet>>& others, bool is_shaft, Cylinder& cylinder) {
    if (others.empty() || !cylinder.is_round(axis, tree)) return;
    std::set<std::uint32_t> corners;
    for (const std::uint32_t f : cylinder.faces) corners.insert(std::begin(tree.faces[f].v), std::end(tree.faces[f].v));
    for (bool more = true; more;) {
      more = false;
      for (auto& [f, facet] : others) {
        const auto& v = tree.faces[f].v;
        if (facet.is_shaft != is_shaft || facet.farthest > cylinder.farthest ||
            facet.nearest < kSmallestFacet * cylinder.farthest ||
            std::none_of(std::begin(v), std::end(v), [&](std::uint32_t corner) { return corners.count(corner) > 0; }))
          continue;
        cylinder.add(f, facet);
        corners.insert(std::begin(v), std::end(v));
        facet.farthest = std::numeric_limits<double>::infinity();  // it is taken
        more = true;
      }
    }
  }

  void allow_turning(const AxisFrame& axis) {
    const Cylinders mine = cylinders_about(axis, own_);
    if (mine.empty()) return;
    const Cylinders theirs = cylinders_about(axis, other_);
    for (const auto& [mine_radius, f] : mine)
      for (const auto& [their_radius, g] : theirs) {
        if (mine_radius * their_radius > 0 || f.end < g.begin || g.end < f.begin) continue;
        const Cylinder &shaft = mine_radius > 0 ? f : g, &bore = mine_radius > 0 ? g : f;
        // A cylinder may have facets of slightly different radii here, and the overlap may be one of facets that never
        // meet. Turning increases the initial depth by at most both sagittas.
        const double most = depth_ + shaft.sagitta + bore.sagitta;
        double overlap = shaft.farthest - bore.nearest;
        if (overlap <= 0 || overlap > most + tolerance_) continue;
        overlap = std::min(overlap, most);
        if (!f.is_round(axis, own_) || !g.is_round(axis, other_)) continue;
        found_.largest = std::max(found_.largest, overlap);
        for (const std::uint32_t face : f.faces) found_.needed[face] = std::max(found_.needed[face], overlap);
      }
  }

  const SolidTree& own_;
  const SolidTree& other_;
  double depth_, tolerance_;
  TurningRetraction found_;
};

}  // namespace

TurningRetraction turning_retraction(const SolidTree& own, const SolidTree& other, double depth, double tolerance) {
  return Turning(own, other, depth, tolerance).find();
}

}  // namespace dismantle
