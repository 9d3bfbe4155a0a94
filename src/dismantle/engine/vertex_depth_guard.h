// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/pair_state.h"
#include "dismantle/bvh/vertex_tree.h"
#include "dismantle/engine/contact.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/solid_tree_query.h"

#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace dismantle {

/// Keeps the second rule of the guarantee (docs/guarantee.md) where triangle pairs cannot: no vertex of a component
/// gets deeper than twice the pair's allowance inside another closed component.
///
/// A triangle that is thinner than the allowance is never "too deep" in another such, so a finely tessellated surface,
/// or one of slivers, would be permeable for the pair. The guard watches the vertices of such pairs by their signed
/// distance to the other surface, which changes by at most the path that they travel. Vertices far from the other
/// surface are watched by spheres: each keeps the slack that was found last, less the way since, and is looked at again
/// (and cut in halves, near the surface) only when its slack may be used up.
class VertexDepthGuard {
 public:
  /// So many times as deep as triangles may be in each other vertices may be.
  static constexpr double kLimit = 2;

  /// The component as a tree of its faces. What it gives must outlive the guard.
  using SolidOf = std::function<const SolidTree&(ComponentId)>;

  /// Watches the Fit pairs, and the Contact pairs that overlap or of which some triangle's least altitude is below
  /// twice the allowance.
  VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, SolidOf solid_of, const Executor& executor);

  /// Makes ready what pairs that are considered later may need, so that no step has to wait for it.
  void prepare();
  /// Watches this pair from now on, too, if it has such triangles; does nothing where it is known already.
  /// @param allowed its allowed penetration [mm]
  void consider(ComponentId a, ComponentId b, double allowed);

  bool watches_nothing() const { return sides_.empty(); }

  /// The vertices that get too deep on the way from state `from` to `to`: one contact a pair of components at most,
  /// with the toi up to which all its vertices are certainly allowed. Relative motions are screws.
  std::vector<BlockingPair> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to);
  /// The same where only the pairs in `touching` can have met on the way: all others are known to be apart.
  std::vector<BlockingPair> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                   Span<const std::pair<ComponentId, ComponentId>> touching);
  /// Makes the end of the last sweep the state that the kept slacks are for. @pre that sweep found nothing
  void commit();
  /// Forgets all slacks: the state was changed without a sweep.
  void jump();

 private:
  enum class Where : std::uint8_t { Unknown, Inside, Outside };
  /// What is known of the vertices in one sphere; together the spheres of a side hold all of the inner's vertices.
  struct Watched {
    VertexNode node;
    std::uint32_t face = NearestFace::kNone;  ///< Of the outer one: the nearest when last looked at.
    Where where = Where::Unknown;             ///< Where the sphere's center was when last looked at.
    double slack = -1;  ///< limit - depth of each of its vertices is at least this, less the way since [mm].
    double clear = 0;   ///< The center was at least this far from the surface, less the way since [mm].
  };
  /// The vertices of one component against the surface of another.
  struct Side {
    ComponentId inner, outer;
    const SolidTree* solid_inner = nullptr;
    const SolidTree* solid_outer = nullptr;
    const VertexTree* tree = nullptr;  ///< Of the inner one.
    double limit = 0;                  ///< Deepest that a vertex may be [mm].
    double resolution = 0;             ///< Slacks below this are used up [mm].
    std::vector<Watched> watched;      ///< In the tree's order.
    double spent = 0;                  ///< Way of all vertices since `watched` was made [mm].
    double least = -1;                 ///< The least slack of all.
    double spent_end = 0;              ///< At the end of the last sweep.
    std::vector<Watched> watched_end;  ///< At the end of the last sweep; empty where `watched` goes on.
  };
  struct Finding {
    double toi = 1;
    std::uint32_t vertex = 0;
    std::uint32_t face = NearestFace::kNone;  ///< Of the outer one; none where nothing was found.
  };
  class Course;

  void watch(ComponentId inner, ComponentId outer, double allowed);
  double thinnest(ComponentId component);
  const VertexTree& tree_of(ComponentId component);
  using MayMeet = std::function<bool(const Side&)>;
  std::vector<BlockingPair> sweep_sides(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                         const MayMeet& may_meet);
  Finding sweep_side(Side& side, const Course& course) const;
  BlockingPair contact_of(const Side& side, const Finding& finding) const;
  static void begin_anew(Side& side);
  static void merge(Side& side);

  const Assembly* assembly_;
  SolidOf solid_of_;
  double tolerance_, largest_allowance_;
  std::vector<double> thinnest_;  ///< Least altitude of any triangle, a component [mm]; negative: not known yet.
  std::vector<std::shared_ptr<const VertexTree>> trees_;  ///< A component; null: not needed yet.
  std::set<std::pair<ComponentId, ComponentId>> known_;
  std::vector<Side> sides_;
  Executor executor_;
};

/// The components' trees, each built when it is first asked for. @param assembly must outlive what it gives
VertexDepthGuard::SolidOf solids_of(const Assembly& assembly, const Executor& executor);

}  // namespace dismantle
