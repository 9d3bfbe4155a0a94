// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/planner/component_set.h"
#include "dismantle/planner/keep_going.h"
#include "dismantle/planner/shape_features.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace dismantle {

using DirectionId = Id<struct DirectionTag>;  ///< Index of a direction within a BlockingTable.

/// Which component blocks which on its way straight to infinity, from the assembled state: facts that are found when
/// they are first asked for and hold for good, whatever else is taken away (Wilson, Latombe 1994: directional blocking
/// graphs). Certified: what does not block is free by the true motion.
class BlockingTable {
 public:
  /// @param engine, features of every component must outlive the table
  /// @param keep_going once it says no, nothing is looked at any more: what is not known then counts as blocked, for that
  /// time
  BlockingTable(const CertificateEngine& engine, Span<const ShapeFeatures> features, KeepGoing keep_going);

  /// @param unit Directions within 1e-6 of each other are one.
  DirectionId add_direction(const Vec3& unit);
  const Vec3& direction(DirectionId d) const { return directions_[d.value]; }
  /// The direction the other way.
  DirectionId opposite(DirectionId d) { return add_direction(-directions_[d.value]); }
  /// A way along `d` after which `moving` is past all that is where it was assembled [mm].
  double exit_distance(ComponentId moving, DirectionId d) const;

  /// A way in any direction after which `moving` is past all that is where it was assembled [mm].
  double max_exit_distance(ComponentId moving) const;
  /// Center and radius of the sphere around an assembled component [mm].
  Vec3 center(ComponentId c) const { return features_[c.value].center; }
  double radius(ComponentId c) const { return features_[c.value].radius; }

  bool blocks(ComponentId moving, DirectionId d, ComponentId fixed);
  /// One of `present` that blocks, if there is one; the same again while it is present.
  std::optional<ComponentId> any_blocker(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// Those of `present` that block, ordered; where there are more than `enough`, so many of them.
  std::vector<ComponentId> blockers(ComponentId moving, DirectionId d, const ComponentSet& present,
                                    std::size_t enough = std::numeric_limits<std::size_t>::max());
  /// The fewest of `present` that can go along `d` together with `moving`: it, what blocks it, what blocks that, ...
  std::vector<ComponentId> moving_together(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// The same, given up (nothing) once it would hold one of `ends`, or more than `most`. Those that cannot go for that
  /// reason are added to `ends`: with the same `present`, `d` and no larger `most` they need not be followed again.
  std::vector<ComponentId> moving_together(ComponentId moving, DirectionId d, const ComponentSet& present,
                                           ComponentSet& ends, std::size_t most);
  /// Tells who may well block a component along a unit direction: they are asked first.
  using Expectation = std::function<std::vector<ComponentId>(ComponentId moving, const Vec3& direction)>;
  /// @pre nothing was asked yet
  void expect_blockers(Expectation expectation) { expectation_ = std::move(expectation); }
  /// Whether one of `present` is expected to block, or known to.
  bool expects_blocker(ComponentId moving, DirectionId d, const ComponentSet& present);
  /// Makes it known that `fixed` blocks by a rule that one sweep does not see.
  void add_blocker(ComponentId moving, DirectionId d, ComponentId fixed);
  /// The first contact with one that blocks.
  std::optional<StraightContact> contact(ComponentId moving, DirectionId d, ComponentId fixed) const;

 private:
  enum class Known : std::uint8_t { Nothing, Free, Blocks };
  struct Row {
    std::vector<Known> known;  // of every component
    ComponentId witness;       // the last one found to block
    std::vector<ComponentId> expected;
  };
  Row& row(ComponentId moving, DirectionId d);
  /// One of `present` that blocks and is not in `together`: the expected ones are asked first, then those of `ends`.
  std::optional<ComponentId> another_blocker(ComponentId moving, DirectionId d, const ComponentSet& present,
                                             const ComponentSet& together, const ComponentSet& ends);
  /// How far `moving` has to go along `d` to be past `fixed`; nothing where it never comes near it [mm].
  double way_past(ComponentId moving, DirectionId d, ComponentId fixed) const;

  const CertificateEngine& engine_;
  Span<const ShapeFeatures> features_;
  KeepGoing keep_going_;
  Expectation expectation_;
  std::vector<Vec3> directions_;
  std::vector<std::map<DirectionId, Row>>
      rows_;  // of every component: rows of different ones may be asked side by side
  std::vector<std::vector<ComponentId>> others_;  // of every component: the last blockers first, then the nearest
};

}  // namespace dismantle
