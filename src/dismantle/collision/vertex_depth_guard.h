// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/collision/collision_engine.h"
#include "dismantle/collision/surface_queries.h"

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
/// distance to the other surface, which changes by at most the path that they travel: each vertex keeps the slack that
/// was found last, less the way since, and is looked at again only when its slack may be used up.
class VertexDepthGuard {
 public:
  /// Watches the Fit and Contact pairs that overlap, or of which some triangle's least altitude is below twice the
  /// allowance.
  VertexDepthGuard(const Assembly& assembly, const PairStates& pairs, const Executor& executor);

  /// Watches this pair from now on, too, if it has such triangles; does nothing where it is known already.
  /// @param allowed its allowed penetration [mm]
  void consider(ComponentId a, ComponentId b, double allowed);

  bool watches_nothing() const { return sides_.empty(); }

  /// The vertices that get too deep on the way from state `from` to `to`: one contact a pair of components at most,
  /// with the toi up to which all its vertices are certainly allowed. Relative motions are screws.
  std::vector<CollisionContact> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to);
  /// The same where only the pairs in `touching` can have met on the way: all others are known to be apart.
  std::vector<CollisionContact> sweep(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                      Span<const std::pair<ComponentId, ComponentId>> touching);
  /// Makes the end of the last sweep the state that the kept slacks are for. @pre that sweep found nothing
  void commit();
  /// Forgets all slacks: the state was changed without a sweep.
  void jump();

 private:
  /// The vertices of one component against the surface of another.
  struct Side {
    ComponentId inner, outer;
    double limit = 0;       ///< Deepest that a vertex may be [mm].
    double resolution = 0;  ///< Slacks below this are used up [mm].
    Vec3 center;            ///< Of a sphere around the inner component [mm, assembled].
    double radius = 0;      ///< [mm]
    /// Lower bound of signed distance + limit, a vertex, less what is `spent` [mm]; below 0: unknown.
    std::vector<double> slack;
    double spent = 0;               ///< Way of all vertices since they were last looked at one by one [mm].
    double least = -1;              ///< Of `slack`.
    double spent_end = 0;           ///< At the end of the last sweep.
    std::vector<double> slack_end;  ///< The same at the end of the last sweep; empty where nothing moved in it.
  };
  struct Finding {
    double toi = 1;
    std::uint32_t vertex = 0;
    NodeIndex leaf = kNoNode;
  };

  void watch(ComponentId inner, ComponentId outer, double allowed);
  double thinnest(ComponentId component);
  using MayMeet = std::function<bool(const Side&)>;
  std::vector<CollisionContact> sweep_sides(Span<const RigidTransform> from, Span<const RigidTransform> to,
                                            const MayMeet& may_meet);
  /// No vertex of the inner component goes further than that [mm].
  static double furthest_way(const Side& side, const RigidTransform& start, const RigidTransform& end);
  Finding sweep_side(Side& side, const RigidTransform& start, const RigidTransform& end) const;
  CollisionContact contact_of(const Side& side, const Finding& finding) const;

  const Assembly* assembly_;
  double tolerance_;
  std::vector<double> thinnest_;  ///< Least altitude of any triangle, a component [mm]; negative: not known yet.
  std::set<std::pair<ComponentId, ComponentId>> known_;
  std::shared_ptr<const AssemblySurface> surface_;  ///< Made with the first pair to watch.
  std::vector<FaceId> face_of_vertex_;              ///< A face at each vertex of the streams.
  std::vector<Side> sides_;
  Executor executor_;
};

/// `engine`, with the guard's findings among its contacts; `engine` itself where the guard has nothing to watch.
std::unique_ptr<CollisionEngine> make_guarded_engine(std::unique_ptr<CollisionEngine> engine, const Assembly& assembly,
                                                     const PairStates& pairs, const Executor& executor);

}  // namespace dismantle
