// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/find_proposals.h"

#include "dismantle/assembly/rigid_groups.h"
#include "dismantle/proposals/part_names.h"
#include "dismantle/proposals/shape_kinds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dismantle {

namespace {

/// Balls of one bearing: so many, of one size within this share, none further from the next than so many radii.
constexpr std::size_t kLeastBalls = 5;
constexpr double kSameSize = 0.02, kFarthestBall = 6;
/// A race, a cage or a seal reaches no further from the middle of the ring than this many times the balls do.
constexpr double kRaceReach = 1.6;
/// A bearing by the names of its components has at least so many.
constexpr std::size_t kLeastOfBearing = 3;
/// A board is no thicker than this share of its width, and carries at least so many components.
constexpr double kBoardThickness = 0.1;
constexpr std::size_t kLeastOnBoard = 10;
/// A soldered part of several solids, such as a chip with its leads, takes up at most this share of the board's volume.
constexpr double kMaxVolumeOnBoard = 0.03;
/// An O-ring's section is at most this share of the outer radius.
constexpr double kMaxSection = 0.3;

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

/// Searches an assembly for proposals.
class ProposalSearch {
 public:
  ProposalSearch(const Assembly& assembly, const PairStates& states)
      : assembly_(assembly), touching_(assembly.components.size()), taken_(assembly.components.size()) {
    for (const ComponentPair& pair : states.pairs) {
      if (pair.state == PairState::Clear || pair.state == PairState::Near) continue;
      touching_[pair.a.value].push_back(pair.b);
      touching_[pair.b.value].push_back(pair.a);
    }
  }

  std::vector<Proposal> run() {
    propose_sub_assemblies();
    propose_bearings();
    propose_named_bearings();
    propose_boards();
    const auto first = [](const Proposal& a, const Proposal& b) { return a.components[0] < b.components[0]; };
    std::stable_sort(found_.begin(), found_.end(), first);
    propose_flexible();
    return std::move(found_);
  }

 private:
  std::size_t count() const { return assembly_.components.size(); }

  void propose_together(std::vector<ComponentId> members, std::string name, std::string reason) {
    std::sort(members.begin(), members.end());
    if (members.size() < 2 || members.size() == count()) return;
    for (const ComponentId c : members) taken_[c.value] = true;
    found_.push_back({Proposal::Kind::Together, std::move(members), {}, std::move(name), std::move(reason)});
  }

  void propose_sub_assemblies() {
    const std::vector<std::vector<ComponentId>> below = components_below(assembly_);
    const std::map<std::string, std::size_t> placed = times_placed(below);
    for (std::uint32_t node = 1; node < below.size(); ++node) {
      const std::string word = purchased_word(assembly_.tree[node].name);
      // The outermost sub-assembly counts; parents come before their children.
      if (below[node].size() < 2 || taken_[below[node][0].value]) continue;
      const std::string& name = assembly_.tree[node].name;
      if (!word.empty()) {
        propose_together(below[node], name, "its name says '" + word + "'");
      } else if (const auto times = placed.find(name); times != placed.end() && times->second > 1) {
        propose_together(below[node], name,
                         "one product of " + std::to_string(below[node].size()) + " solids, placed " +
                             std::to_string(times->second) + " times");
      }
    }
  }

  /// How often products of several solids are placed: their solids are called as they are.
  std::map<std::string, std::size_t> times_placed(const std::vector<std::vector<ComponentId>>& below) const {
    std::map<std::string, std::size_t> placed;
    for (std::uint32_t node = 1; node < below.size(); ++node) {
      const std::string& name = assembly_.tree[node].name;
      const auto is_called_so = [&](ComponentId c) {
        const std::string& own = assembly_[c].name;
        return own.compare(0, name.size(), name) == 0 && (own.size() == name.size() || own[name.size()] == '#');
      };
      if (below[node].size() > 1 && std::all_of(below[node].begin(), below[node].end(), is_called_so)) ++placed[name];
    }
    return placed;
  }

  void propose_bearings() {
    struct Ball {
      ComponentId component;
      BallShape shape;
    };
    std::vector<Ball> balls;
    std::map<const TriangleMesh*, std::optional<BallShape>> known;
    for (std::uint32_t c = 0; c < count(); ++c) {
      const Component& component = assembly_.components[c];
      const auto [shape, is_new] = known.try_emplace(component.mesh.get());
      if (is_new) shape->second = ball_shape(*component.mesh);
      if (!taken_[c] && shape->second)
        balls.push_back(
            {ComponentId(c), {component.assembly_from_mesh * shape->second->center, shape->second->radius}});
    }
    // Equal balls that are near each other make a ring.
    std::vector<bool> seen(balls.size());
    for (std::size_t first = 0; first < balls.size(); ++first) {
      if (seen[first]) continue;
      std::vector<std::size_t> ring{first};
      seen[first] = true;
      for (std::size_t at = 0; at < ring.size(); ++at)
        for (std::size_t k = 0; k < balls.size(); ++k) {
          const double radius = balls[ring[at]].shape.radius;
          if (seen[k] || std::abs(balls[k].shape.radius - radius) > kSameSize * radius ||
              length(balls[k].shape.center - balls[ring[at]].shape.center) > kFarthestBall * radius)
            continue;
          seen[k] = true;
          ring.push_back(k);
        }
      if (ring.size() < kLeastBalls) continue;
      std::vector<ComponentId> members;
      std::vector<BallShape> shapes;
      for (const std::size_t k : ring) {
        members.push_back(balls[k].component);
        shapes.push_back(balls[k].shape);
      }
      if (in_circle(shapes)) propose_bearing(std::move(members), shapes);
    }
  }

  static Vec3 middle_of(const std::vector<BallShape>& balls) {
    Vec3 middle;
    for (const BallShape& ball : balls) middle += ball.center / static_cast<double>(balls.size());
    return middle;
  }

  /// True if the balls are equally far from their middle and in one plane.
  static bool in_circle(const std::vector<BallShape>& balls) {
    const Vec3 middle = middle_of(balls);
    const double radius = balls[0].radius, reach = length(balls[0].center - middle);
    Vec3 normal;
    for (const BallShape& ball : balls) {
      const Vec3 across = cross(balls[0].center - middle, ball.center - middle);
      if (length_squared(across) > length_squared(normal)) normal = across;
    }
    normal = normalized(normal);
    return std::all_of(balls.begin(), balls.end(), [&](const BallShape& ball) {
      const Vec3 from = ball.center - middle;
      return std::abs(length(from) - reach) < radius / 2 && std::abs(dot(normal, from)) < radius / 2;
    });
  }

  void propose_bearing(std::vector<ComponentId> members, const std::vector<BallShape>& balls) {
    const Vec3 middle = middle_of(balls);
    const std::size_t count_of_balls = members.size();
    const double ring = length(balls[0].center - middle), reach = kRaceReach * (ring + balls[0].radius);
    for (std::uint32_t c = 0; c < count(); ++c) {
      if (std::find(members.begin(), members.end(), ComponentId(c)) != members.end()) continue;
      const TriangleMesh mesh = assembled_mesh(assembly_.components[c]);
      const auto shape = ring_shape(mesh);
      // A race is a ring about the middle, with the balls in or around it.
      if (!shape || length(shape->center - middle) > balls[0].radius || shape->outer > reach ||
          shape->outer < ring - balls[0].radius - ring / 2)
        continue;
      members.emplace_back(c);
    }
    const std::string races = std::to_string(members.size() - count_of_balls);
    const std::string name = assembly_[members[0]].name;
    if (members.size() > count_of_balls)
      propose_together(std::move(members), name,
                       std::to_string(count_of_balls) + " equal balls in a circle, with " + races + " rings about it");
  }

  /// Components whose names say that they are of one bearing, where they are in one place.
  void propose_named_bearings() {
    std::map<std::string, std::vector<ComponentId>> named;
    for (std::uint32_t c = 0; c < count(); ++c)
      if (const std::string name = bearing_of(assembly_.components[c].name); !taken_[c] && !name.empty())
        named[name].emplace_back(c);
    for (auto& [name, waiting] : named)
      while (!waiting.empty()) {
        std::vector<ComponentId> members{waiting.back()};
        waiting.pop_back();
        for (std::size_t at = 0; at < members.size(); ++at) {
          const Aabb box = assembled_bounds(assembly_[members[at]]);
          const auto is_beside = [&](ComponentId c) { return overlaps(box, assembled_bounds(assembly_[c])); };
          const auto beside =
              std::stable_partition(waiting.begin(), waiting.end(), [&](ComponentId c) { return !is_beside(c); });
          members.insert(members.end(), beside, waiting.end());
          waiting.erase(beside, waiting.end());
        }
        if (members.size() < kLeastOfBearing) continue;
        const std::string size = std::to_string(members.size());
        propose_together(std::move(members), name, "the names of " + size + " components say that they are of it");
      }
  }

  void propose_boards() {
    for (std::uint32_t c = 0; c < count(); ++c) {
      if (taken_[c] || touching_[c].size() < kLeastOnBoard) continue;
      const Vec3 lengths = principal_lengths(*assembly_.components[c].mesh);
      if (!(lengths.x <= kBoardThickness * lengths.y)) continue;
      // What touches anything else is no part of the board: screws, what it stands on.
      std::vector<ComponentId> on_it = touching_[c];
      for (bool changed = true; changed;) {
        std::vector<bool> inside(count());
        inside[c] = true;
        for (const ComponentId k : on_it) inside[k.value] = true;
        const auto touches_more = [&](ComponentId k) {
          return taken_[k.value] || std::any_of(touching_[k.value].begin(), touching_[k.value].end(),
                                                [&](ComponentId other) { return !inside[other.value]; });
        };
        changed = std::erase_if(on_it, touches_more) > 0;
      }
      if (on_it.size() < kLeastOnBoard) continue;
      add_clusters(ComponentId(c), on_it);
      const std::string size = std::to_string(on_it.size());
      on_it.emplace_back(c);
      propose_together(std::move(on_it), assembly_.components[c].name,
                       "a plate with " + size + " components that touch nothing else");
    }
  }

  /// Adds to what is `on_it` the small components of several solids that touch the board and nothing else.
  void add_clusters(ComponentId board, std::vector<ComponentId>& on_it) const {
    const double most = kMaxVolumeOnBoard * box_volume(board);
    std::vector<bool> seen(count());
    seen[board.value] = true;
    for (const ComponentId c : on_it) seen[c.value] = true;
    for (const ComponentId first : touching_[board.value]) {
      if (seen[first.value]) continue;
      std::vector<ComponentId> cluster{first};
      double volume = 0;
      seen[first.value] = true;
      bool is_free = true;
      for (std::size_t at = 0; at < cluster.size(); ++at) {
        volume += box_volume(cluster[at]);
        is_free = is_free && !taken_[cluster[at].value];
        for (const ComponentId other : touching_[cluster[at].value]) {
          if (seen[other.value]) continue;
          seen[other.value] = true;
          cluster.push_back(other);
        }
      }
      if (is_free && volume <= most) on_it.insert(on_it.end(), cluster.begin(), cluster.end());
    }
  }

  /// Of a box along the principal axes [mm^3].
  double box_volume(ComponentId c) const {
    const Vec3 lengths = principal_lengths(*assembly_[c].mesh);
    return lengths.x * lengths.y * lengths.z;
  }

  void propose_flexible() {
    std::map<const TriangleMesh*, std::optional<RingShape>> known;
    for (std::uint32_t c = 0; c < count(); ++c) {
      if (taken_[c] || touching_[c].empty()) continue;
      const Component& component = assembly_.components[c];
      const auto [shape, is_new] = known.try_emplace(component.mesh.get());
      if (is_new) shape->second = ring_shape(*component.mesh);
      const std::string word = flexible_word(component.name);
      std::string reason;
      if (const auto& ring = shape->second) {
        const double width = ring->outer - ring->inner;
        if (ring->is_torus && width <= 2 * kMaxSection * ring->outer)
          reason = "a torus, as O-rings are";
        else if (is_circlip(*ring))
          reason = "an open ring, as circlips are";
      }
      if (reason.empty() && !word.empty()) reason = "its name says " + quoted(word);
      if (reason.empty()) continue;
      const FlexiblePart part = flexible_part(assembly_, ComponentId(c));
      if (part.overlap > 0)
        found_.push_back({Proposal::Kind::Flexible, {ComponentId(c)}, part, component.name, reason});
    }
  }

  const Assembly& assembly_;
  std::vector<std::vector<ComponentId>> touching_;
  std::vector<bool> taken_;  // belongs to a proposed group
  std::vector<Proposal> found_;

 public:
  /// A component that gives by its thickness.
  static FlexiblePart flexible_part(const Assembly& assembly, ComponentId c) {
    const Component& component = assembly[c];
    FlexiblePart part{c, section_of(*component.mesh), {}};
    if (const auto ring = ring_shape(*component.mesh)) {
      part.overlap = std::max(part.overlap, ring->outer - ring->inner);
      part.axis = component.assembly_from_mesh.rotation * ring->axis;
    }
    return part;
  }
};

}  // namespace

std::vector<Proposal> find_proposals(const Assembly& assembly, const PairStates& states) {
  return ProposalSearch(assembly, states).run();
}

Result<std::vector<FlexiblePart>> named_flexible(const Assembly& assembly, Span<const std::string> texts) {
  std::vector<FlexiblePart> parts;
  for (const std::string& text : texts) {
    std::string name = text;
    double overlap = 0;
    // A name may hold a "=" itself.
    const std::size_t sign = text.rfind('=');
    if (components_named(assembly, text).empty() && sign != std::string::npos) {
      char* end = nullptr;
      overlap = std::strtod(text.c_str() + sign + 1, &end);
      if (*end != '\0' || end == text.c_str() + sign + 1 || !(overlap > 0) || !std::isfinite(overlap))
        return Error{ErrorKind::Usage,
                     "'" + text + "' gives no depth (what follows '=' is no number above 0); write NAME=MM"};
      name.resize(sign);
    }
    const std::vector<ComponentId> fitting = components_named(assembly, name);
    if (fitting.empty())
      return Error{ErrorKind::Usage,
                   "'" + name + "' is unknown (no component has such a name); 'dismantle info' lists them"};
    for (const ComponentId c : fitting) {
      FlexiblePart part = ProposalSearch::flexible_part(assembly, c);
      if (overlap > 0) part.overlap = overlap;
      parts.push_back(part);
    }
  }
  return parts;
}

}  // namespace dismantle
