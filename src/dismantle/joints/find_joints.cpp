// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/find_joints.h"

#include "dismantle/core/contract.h"
#include "dismantle/joints/axial_rays.h"
#include "dismantle/joints/shank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

using Kind = Fastener::Kind;

/// A component surrounds a shank if its material begins within this many times its radius (wide clearance holes are
/// ISO 273, coarse: 1.25), on at least half of the rays.
constexpr double kReach = 1.35;
constexpr std::size_t kHalf = AxialRays::kRays / 2;
/// Material in which the axis lies counts where it reaches to this share of the shank's radius: holes that were not
/// drawn, or only at the root of the thread.
constexpr double kSolid = 0.9;
/// A hole is that of a thread up to this many times its radius: fine clearance holes are 1.03 and more.
constexpr double kTight = 1.02;
/// A head or a nut presses on material on at least this share of the rays.
constexpr std::size_t kQuarter = AxialRays::kRays / 4;
/// Distance beyond the face of a nut at which what it presses on is looked for, in diameters of its thread.
constexpr double kBeyond = 0.1;
/// A stud in a nut reaches at least and at most to these shares of the nut's nominal radius.
constexpr double kStudLeast = 0.7, kStudMost = 1.1;
/// The insert of a lock nut is inside its box, but for this share of the box's diagonal.
constexpr double kInsertBeyond = 0.05;
/// Number of planes through a nut.
constexpr int kNutPlanes = 8;

/// The planes of a shank that a component surrounds.
struct Surrounding {
  ComponentId component;
  std::size_t first = 0, last = 0;  ///< The outermost planes.
  double mean = 0;                  ///< Of their indices.
  bool is_tight = false;            ///< Its hole is no wider than the thread, at some plane.
  std::size_t last_tight = 0;       ///< The last plane of the tight ones nearest to the tip that follow each other.
};

std::optional<Surrounding> surrounding_of(const Shank& shank, const AxialRays& rays, ComponentId c) {
  Surrounding found;
  std::size_t count = 0;
  for (std::size_t k = 1; k < shank.end; ++k) {
    const double radius = std::min(shank.radii[k], shank.has_head ? shank.head_radius : INFINITY);
    if (!(radius > 0) || rays.surrounding(k, kReach * radius, kSolid * radius) < kHalf) continue;
    if (count == 0) found.first = k;
    found.last = k;
    found.mean += static_cast<double>(k);
    ++count;
    if (rays.hole(k) > kTight * shank.thread_radius) continue;
    if (!found.is_tight || found.last_tight + 2 >= k) found.last_tight = k;
    found.is_tight = true;
  }
  if (count == 0) return std::nullopt;
  found.component = c;
  found.mean /= static_cast<double>(count);
  return found;
}

/// True if the head presses on a component, or the tip of a screw without a head does.
bool is_pressed(const Shank& shank, const AxialRays& rays) {
  if (!shank.has_head) return rays.inside_at(0, shank.thread_radius / 2) >= kHalf;
  const std::size_t below = shank.end - 1;
  return rays.inside_at(below, (shank.radii[below] + shank.head_radius) / 2) >= kQuarter;
}

Unscrewing unscrewing_of(double travel, const Fastener& f) {
  return {f.pitch > 0 ? travel / f.pitch : 0, travel, f.pitch, f.left_handed, !f.thread_is_modelled};
}

void sort_unique(std::vector<ComponentId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Finds the joints of one assembly.
class JointSearch {
 public:
  JointSearch(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners)
      : assembly_(assembly), fasteners_(fasteners) {
    boxes_.reserve(assembly.components.size());
    for (const Component& c : assembly.components) boxes_.push_back(assembled_bounds(c));
  }

  bool is(ComponentId c, Kind kind) const { return fasteners_[c.value] && fasteners_[c.value]->kind == kind; }

  /// The joint of a screw or a standoff.
  std::optional<Joint> of_screw(ComponentId screw) const {
    const Fastener& f = *fasteners_[screw.value];
    const std::optional<Shank> shank = shank_of(assembly_[screw], f);
    if (!shank) return std::nullopt;
    std::vector<Surrounding> around;
    std::vector<ComponentId> pressed;
    for (const ComponentId c : near(screw, shank->step)) {
      const AxialRays rays(assembly_[c], shank->frame, shank->positions);
      if (rays.empty()) continue;
      if (const auto found = surrounding_of(*shank, rays, c)) {
        around.push_back(*found);
      } else if (is_pressed(*shank, rays)) {
        pressed.push_back(c);
      }
    }
    std::stable_sort(around.begin(), around.end(),
                     [](const Surrounding& a, const Surrounding& b) { return a.mean < b.mean; });
    const Surrounding* thread =
        shank->has_head ? thread_of(around.begin(), around.end()) : thread_of(around.rbegin(), around.rend());
    if (thread == nullptr) return std::nullopt;

    Joint joint;
    joint.screw = screw;
    joint.has_head = shank->has_head;
    joint.axis = shank->frame.direction;
    joint.screw_leaves = unscrewing_of(shank->from_tip(end_of_thread(*thread)), f);
    for (const Surrounding& s : around)
      if (is(s.component, Kind::Nut)) joint.nuts.push_back(s.component);
    for (const Surrounding& s : around)
      if (!joint.nuts.empty() && s.component == joint.nuts.front())
        joint.nut_leaves = unscrewing_of(shank->from_tip(s.last), f);
    joint.thread_in = thread->component;
    for (const ComponentId nut : joint.nuts)
      if (is_inside(thread->component, nut)) joint.thread_in = nut;
    sort_rest(around, joint);
    joint.held.insert(joint.held.end(), pressed.begin(), pressed.end());
    sort_unique(joint.held);
    return joint;
  }

  /// The joint of a nut that is on no recognised screw.
  std::optional<Joint> of_nut(ComponentId nut) const {
    const Fastener& f = *fasteners_[nut.value];
    const AxisFrame frame(assembly_[nut].assembly_from_mesh * f.point,
                          assembly_[nut].assembly_from_mesh.rotation * f.axis);
    const Ends ends = ends_of(nut, frame);
    const double radius = f.diameter / 2;
    if (!(radius > 0) || !(ends.high > ends.low)) return std::nullopt;
    Joint joint;
    joint.nuts = {nut};
    joint.axis = frame.direction;
    joint.nut_leaves = unscrewing_of(ends.high - ends.low, f);
    const std::vector<ComponentId> others = near(nut, 2 * kBeyond * f.diameter);
    for (const ComponentId c : others)
      if (!joint.thread_in.valid() && fills(c, frame, ends, radius)) joint.thread_in = c;
    if (!joint.thread_in.valid()) return std::nullopt;
    add_pressed(nut, frame, ends, f.diameter, joint);
    for (const ComponentId washer : std::vector<ComponentId>(joint.nut_washers))
      add_pressed(washer, frame, ends_of(washer, frame), f.diameter, joint);
    joint.held.push_back(joint.thread_in);
    std::erase(joint.held, nut);
    std::erase_if(joint.nut_inserts, [&](const NutInsert& ring) { return ring.insert == joint.thread_in; });
    std::sort(joint.nut_inserts.begin(), joint.nut_inserts.end());
    sort_unique(joint.held);
    sort_unique(joint.nut_washers);
    return joint;
  }

 private:
  /// Where a component begins and ends along an axis [mm].
  struct Ends {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  };
  Ends ends_of(ComponentId c, const AxisFrame& frame) const {
    Ends ends;
    for (const Vec3& v : assembled_vertices(assembly_[c])) {
      ends.low = std::min(ends.low, frame.along(v));
      ends.high = std::max(ends.high, frame.along(v));
    }
    return ends;
  }

  /// The other components whose boxes come within a distance of that of `c` [mm].
  std::vector<ComponentId> near(ComponentId c, double distance) const {
    const Aabb box = inflated(boxes_[c.value], distance);
    std::vector<ComponentId> found;
    for (std::uint32_t other = 0; other < boxes_.size(); ++other)
      if (other != c.value && overlaps(box, boxes_[other])) found.emplace_back(other);
    return found;
  }

  /// The component with the inner thread, out of those around a screw, the most likely first; null if there is none.
  template <class Iterator>
  const Surrounding* thread_of(Iterator first, Iterator last) const {
    const Surrounding* any = nullptr;
    for (; first != last; ++first) {
      const Surrounding& s = *first;
      const ComponentId c = s.component;
      if (is(c, Kind::Washer)) continue;
      if (s.is_tight || is(c, Kind::Nut) || is(c, Kind::Insert) || is(c, Kind::Standoff)) return &s;
      if (any == nullptr) any = &s;
    }
    return any;
  }

  /// True for the insert of a nut.
  bool is_inside(ComponentId c, ComponentId nut) const {
    const Aabb& box = boxes_[nut.value];
    const Aabb most = inflated(box, kInsertBeyond * diagonal(box));
    Aabb both = most;
    both.extend(boxes_[c.value]);
    return both == most;
  }

  std::size_t end_of_thread(const Surrounding& thread) const {
    return thread.is_tight && !is(thread.component, Kind::Nut) ? thread.last_tight : thread.last;
  }

  /// Sorts what surrounds a shank into washers and held components. @param around by position, from the tip
  void sort_rest(const std::vector<Surrounding>& around, Joint& joint) const {
    for (const Surrounding& s : around) {
      if (is(s.component, Kind::Nut)) continue;
      const auto nut =
          std::find_if(joint.nuts.begin(), joint.nuts.end(), [&](ComponentId n) { return is_inside(s.component, n); });
      if (nut != joint.nuts.end()) {
        joint.nut_inserts.push_back({s.component, *nut});
        continue;
      }
      if (!is(s.component, Kind::Washer)) {
        joint.held.push_back(s.component);
      } else if (joint.held.empty() && !joint.nuts.empty()) {
        joint.nut_washers.push_back(s.component);
      } else {
        joint.head_washers.push_back(s.component);
      }
    }
    std::sort(joint.nut_inserts.begin(), joint.nut_inserts.end());
    sort_unique(joint.nut_washers);
    sort_unique(joint.head_washers);
  }

  /// True if a component has an outer cylinder in the hole of a nut.
  bool fills(ComponentId c, const AxisFrame& frame, const Ends& ends, double radius) const {
    std::vector<double> positions;
    positions.reserve(kNutPlanes);
    for (int k = 0; k < kNutPlanes; ++k)
      positions.push_back(ends.low + (k + 0.5) / kNutPlanes * (ends.high - ends.low));
    const AxialRays rays(assembly_[c], frame, positions);
    int filled = 0;
    for (std::size_t k = 0; k < positions.size() && !rays.empty(); ++k)
      filled += rays.inside_at(k, kStudLeast * radius) >= kHalf && rays.inside_at(k, kStudMost * radius) == 0;
    return 2 * filled >= kNutPlanes;
  }

  /// Adds what a nut or a washer presses on, beyond its ends.
  void add_pressed(ComponentId by, const AxisFrame& frame, const Ends& ends, double diameter, Joint& joint) const {
    const double beyond = kBeyond * diameter;
    const std::array<double, 2> faces{ends.low - beyond, ends.high + beyond};
    const std::vector<double> positions(faces.begin(), faces.end());
    const std::vector<double> middle{(ends.low + ends.high) / 2};
    const double outer = AxialRays(assembly_[by], frame, middle).outer(0);
    const double radius = (diameter / 2 + std::max(outer, diameter / 2)) / 2;
    for (const ComponentId c : near(by, 2 * beyond)) {
      if (is(by, Kind::Nut) && is_inside(c, by)) {
        joint.nut_inserts.push_back({c, by});
        continue;
      }
      const AxialRays rays(assembly_[c], frame, positions);
      if (rays.empty() || std::max(rays.inside_at(0, radius), rays.inside_at(1, radius)) < kQuarter) continue;
      if (std::find(joint.nuts.begin(), joint.nuts.end(), c) != joint.nuts.end()) continue;
      (is(c, Kind::Washer) ? joint.nut_washers : joint.held).push_back(c);
    }
  }

  const Assembly& assembly_;
  const std::vector<std::optional<Fastener>>& fasteners_;
  std::vector<Aabb> boxes_;
};

}  // namespace

std::vector<Joint> find_joints(const Assembly& assembly, const std::vector<std::optional<Fastener>>& fasteners,
                               const Executor& executor) {
  DISMANTLE_EXPECT(fasteners.size() == assembly.components.size());
  const JointSearch search(assembly, fasteners);
  const auto of_all = [&](const auto& is_searched, const auto& find) {
    std::vector<std::optional<Joint>> found(fasteners.size());
    executor.for_each_heavy(found.size(), [&](std::size_t c) {
      const ComponentId id(static_cast<std::uint32_t>(c));
      if (fasteners[c] && is_searched(id)) found[c] = find(id);
    });
    return found;
  };
  std::vector<Joint> joints;
  std::vector<bool> is_on_screw(fasteners.size());
  for (std::optional<Joint>& joint :
       of_all([&](ComponentId c) { return search.is(c, Kind::Screw) || search.is(c, Kind::Standoff); },
              [&](ComponentId c) { return search.of_screw(c); }))
    if (joint) {
      for (const ComponentId nut : joint->nuts) is_on_screw[nut.value] = true;
      joints.push_back(std::move(*joint));
    }
  for (std::optional<Joint>& joint :
       of_all([&](ComponentId c) { return search.is(c, Kind::Nut) && !is_on_screw[c.value]; },
              [&](ComponentId c) { return search.of_nut(c); }))
    if (joint) joints.push_back(std::move(*joint));
  return joints;
}

}  // namespace dismantle
