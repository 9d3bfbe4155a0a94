// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/append_times.h"

#include "dismantle/collision/moving_streams.h"
#include "dismantle/collision/stage_clock.h"
#include "dismantle/front/front.h"

#include <algorithm>
#include <deque>
#include <limits>

namespace dismantle {

namespace {

constexpr std::size_t kCapacity = 1 << 16;  // as the methods have it

std::size_t value_count(const FrontAppender& appender) {
  std::size_t count = 0;
  for (const auto stream :
       {FrontAppender::TrianglePairs, FrontAppender::Kept, FrontAppender::Rested, FrontAppender::Sprouted})
    count += appender.values(stream).size();
  return count;
}

/// The least time of some runs [ms].
double least_ms(FrontAppender& appender, const FrontSproutKernel& kernel, const Executor& executor, int repeats) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    StageClock clock;
    appender.run(kernel, executor);
    least = std::min(least, clock.total());
  }
  return least;
}

}  // namespace

std::vector<AppendTime> time_appends(const BenchScene& scene, int cores, int repeats) {
  const Executor executor = cores > 1 ? Executor(ExecutorKind::Threads, cores) : Executor();
  MovingStreams streams(scene.assembly, executor);
  Front front(kCapacity);
  std::vector<AppendTime> times;
  std::deque<FrontAppender> appenders;  // they cannot be moved
  for (const AppendVariant variant : kAppendVariants) {
    times.push_back({variant});
    appenders.emplace_back(variant, kCapacity);
  }
  const BenchMove& move = scene.moves.front();
  const NodeIndex root = streams.fixed().bvh.root();
  const std::vector<std::uint64_t> start{pair_key(root, root)};
  std::vector<RigidTransform> next(streams.state().begin(), streams.state().end());
  for (std::size_t k = 0; k < move.targets.size(); ++k) {
    for (const ComponentId c : move.components) next[c.value] = transform_from_pose(move.targets[k]);
    streams.set_next(next, executor);
    streams.refit(executor);
    const FrontInput input{BvhView(streams.fixed().bvh), streams.bounds(), streams.motion_class()};
    FrontSproutKernel kernel{input.tree, input.bounds, input.motion_class, start};
    for (std::size_t v = 0; v < times.size() && k > 0; ++v) {  // the first step has no front to keep
      kernel.items = start;
      times[v].start_ms += least_ms(appenders[v], kernel, executor, repeats);
      times[v].started = value_count(appenders[v]);
      kernel.items = front.active();
      times[v].update_ms += least_ms(appenders[v], kernel, executor, repeats);
      times[v].updated = value_count(appenders[v]);
    }
    front.update(input, executor);
    streams.commit();
  }
  for (AppendTime& time : times) {
    time.start_ms /= static_cast<double>(std::max<std::size_t>(2, move.targets.size()) - 1);
    time.update_ms /= static_cast<double>(std::max<std::size_t>(2, move.targets.size()) - 1);
  }
  return times;
}

}  // namespace dismantle
