// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/streams/sweep_engine.h"

#include <memory>
#include <vector>

namespace dismantle {

/// Watches the embedded pairs (the paper's S_i) for the moment at which they are apart: until then they are free, from
/// then on they are like all others. Each pair has an engine of method `streams` over its two components alone, which
/// knows how to tell that moment on the true paths (parting.h).
class EmbeddedWatch {
 public:
  EmbeddedWatch(const Assembly& assembly, const PairStates& pairs, const Executor& executor);

  bool empty() const { return watched_.empty(); }
  std::vector<ComponentPair> pairs() const;

  /// Follows the set in hand along the screw from `start` to `end`, as far as pairs that part on the way let it, and
  /// stays there.
  /// @param held of each component: whether it is in hand
  /// @param cuts into how many equal pieces the motion is cut so that each one's arcs are within `deviation` of their
  ///        chords
  /// @return the part of the motion made, in [0, 1]
  double follow(const std::vector<bool>& held, Span<const Pose> poses, const Pose& start, const Pose& end, int cuts,
                double deviation);
  /// All components are at these poses now.
  void jump(Span<const Pose> poses);
  /// The pairs that have parted since this was last asked; they are watched no more.
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
