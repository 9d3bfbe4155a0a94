// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/response/embedded_watch.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/engine/vertex_depth_guard.h"

#include <utility>
#include <vector>

namespace dismantle {

/// Moves the moving set of a CertificateSweeper along motions that the certificates allow, and keeps the two rules that
/// these do not cover: embedded pairs that part, and vertices that get too deep in closed components.
class GuardedMover {
 public:
  /// The treatment by advance() of a motion along which a vertex would get too deep.
  enum class Shortening {
    Allowed,  ///< Makes the part before that.
    None,     ///< Makes nothing of it.
  };

  /// The sweeper and the assembly must outlive the mover.
  GuardedMover(CertificateSweeper& sweeper, const Assembly& assembly, const PairStates& pairs);

  /// Sets the component pairs that may have touched in the sweep of the motion that is made next.
  void set_near_component_pairs(std::vector<std::pair<ComponentId, ComponentId>> pairs);
  /// Moves the set along `fraction` of a motion from its pose, which the certificates allow, or as far as the other two
  /// rules let it. @return the fraction made
  double advance(const ScrewMotion& motion, double fraction, Shortening shortening);
  /// The vertices that shortened the last advance().
  const std::vector<BlockingPair>& blocking_vertices() const { return blocking_vertices_; }
  /// Forgets the vertices that shortened the last advance().
  void clear_blocking_vertices() { blocking_vertices_.clear(); }
  /// Puts all components at `poses` without a test.
  void jump(Span<const Pose> poses);
  /// The pairs that are still embedded.
  std::vector<ComponentPair> embedded_pairs() const { return embedded_.pairs(); }

 private:
  /// The fraction, up to `fraction`, of a motion that both rules allow; their state follows.
  double follow(const ScrewMotion& motion, double fraction, Shortening shortening);
  double guarded_fraction(const ScrewMotion& motion, double fraction, Shortening shortening);
  /// Lets the sweeper sweep the pairs that have parted.
  void adopt_parted();

  CertificateSweeper& sweeper_;
  VertexDepthGuard guard_;
  EmbeddedWatch embedded_;
  std::vector<RigidTransform> from_, to_;  ///< Of each component, for the guard.
  std::vector<bool> is_moving_;            ///< Of each component, for the watch.
  std::vector<std::pair<ComponentId, ComponentId>> near_component_pairs_;
  std::vector<BlockingPair> blocking_vertices_;
};

}  // namespace dismantle
