// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/screw.h"
#include "dismantle/streams/sweep_engine.h"

#include <memory>
#include <vector>

namespace dismantle {

/// Watches the embedded pairs (the paper's S_i) for the moment at which they part: until then they are free to move,
/// from then on they are like all others. Each pair has an engine of method `streams` over its two components, which
/// finds that moment on the true paths (parting.h).
class EmbeddedWatch {
 public:
  /// Watches the embedded pairs of `pairs`, in the assembled state.
  EmbeddedWatch(const Assembly& assembly, const PairStates& pairs, const Executor& executor);

  /// True if no pair is embedded.
  bool empty() const { return watched_.empty(); }
  /// The pairs that are still embedded.
  std::vector<ComponentPair> pairs() const;

  /// Follows the moving set along a motion, as far as pairs that part on the way allow, and keeps the state there.
  /// @param is_moving of each component: true if it is in the moving set
  /// @param poses of each component
  /// @param max_deviation the motion is divided until its arcs are so close to their chords [mm]
  /// @return the fraction of the motion made, in [0, 1]
  double follow(const std::vector<bool>& is_moving, Span<const Pose> poses, const ScrewMotion& motion,
                double max_deviation);
  /// Puts all components at these poses without a test.
  void jump(Span<const Pose> poses);
  /// The pairs that have parted since the last call; they are no longer watched.
  std::vector<ComponentPair> take_parted();

 private:
  struct Watched {
    ComponentPair pair;
    std::unique_ptr<Assembly> assembly;  // of the two components
    std::unique_ptr<SweepEngine> engine;
  };

  std::vector<Watched> watched_;
};

}  // namespace dismantle
