// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/append_times.h"

#include "bench/baselines/device_appender.h"
#include "dismantle/streams/bvtt_front.h"
#include "dismantle/streams/moving_streams.h"
#include "dismantle/streams/stage_clock.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <utility>

namespace dismantle {

namespace {

constexpr std::size_t kCapacity = 1 << 16;  // as in the methods

/// One variant, on the CPU or on a device.
class TimedAppender {
 public:
  TimedAppender(AppendVariant variant, const Executor& executor) : on_host_(variant, kCapacity), executor_(executor) {}
  explicit TimedAppender(std::unique_ptr<DeviceAppender> device)
      : TimedAppender(AppendVariant::GlobalLock, Executor()) {
    on_device_ = std::move(device);
  }

  /// The shortest time of some runs [ms].
  double shortest_ms(const FrontSproutKernel& kernel, int repeats) {
    double shortest = std::numeric_limits<double>::infinity();
    if (on_device_) on_device_->set_input(kernel);
    for (int i = 0; i < repeats; ++i)
      shortest = std::min(shortest, on_device_ ? on_device_->run(kernel.items) : run(kernel));
    return shortest;
  }
  std::size_t value_count() const {
    std::size_t count = 0;
    for (const auto stream :
         {FrontAppender::TrianglePairs, FrontAppender::Kept, FrontAppender::Rested, FrontAppender::Sprouted})
      count += on_device_ ? on_device_->values(stream).size() : on_host_.values(stream).size();
    return count;
  }

 private:
  double run(const FrontSproutKernel& kernel) {
    StageClock clock;
    on_host_.run(kernel, executor_);
    return clock.total();
  }

  FrontAppender on_host_;
  Executor executor_;
  std::unique_ptr<DeviceAppender> on_device_;  // used instead of on_host_ where there is one
};

Result<std::deque<TimedAppender>> make_appenders(const AppendRuns& runs, const Executor& executor) {
  std::deque<TimedAppender> appenders;  // TimedAppender cannot be moved
  for (const AppendVariant variant : runs.variants) {
    if (!runs.on_device) {
      appenders.emplace_back(variant, executor);
      continue;
    }
    Result<std::unique_ptr<DeviceAppender>> device = make_device_appender(variant, kCapacity);
    if (!device) return device.error();
    appenders.emplace_back(std::move(*device));
  }
  return appenders;
}

}  // namespace

Result<std::vector<AppendTime>> time_appends(const BenchScene& scene, const AppendRuns& asked) {
  AppendRuns runs = asked;
  if (runs.variants.empty() && runs.on_device)
    runs.variants.assign(std::begin(kDeviceAppendVariants), std::end(kDeviceAppendVariants));
  if (runs.variants.empty()) runs.variants.assign(std::begin(kAppendVariants), std::end(kAppendVariants));
  const Executor executor = runs.cores > 1 ? Executor(ExecutorKind::Threads, runs.cores) : Executor();
  Result<std::deque<TimedAppender>> made = make_appenders(runs, executor);
  if (!made) return made.error();
  std::deque<TimedAppender>& appenders = *made;
  MovingStreams streams(scene.assembly, executor);
  Front front(kCapacity);
  std::vector<AppendTime> times;
  for (const AppendVariant variant : runs.variants) times.push_back({variant});
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
    for (std::size_t v = 0; v < times.size() && k > 0; ++v) {  // the first step has no front to update
      kernel.items = start;
      times[v].start_ms += appenders[v].shortest_ms(kernel, runs.repeats);
      times[v].started = appenders[v].value_count();
      kernel.items = front.active();
      times[v].update_ms += appenders[v].shortest_ms(kernel, runs.repeats);
      times[v].updated = appenders[v].value_count();
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
