// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/bvtt_front.h"

#include "dismantle/exec/radix_sort.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Nodes of the front in one task: a visit takes 5 to 20 ns.
constexpr std::size_t kNodesPerRange = 2048;
/// Pending pairs in one task: each may take up to kFrontWorkBudget visits.
constexpr std::size_t kPendingPerRange = 4;
/// Distance of prefetches [nodes]: a visit takes about a tenth of a memory access.
constexpr std::size_t kPrefetchDistance = 12;

/// Prefetches the bounds of a pair that is visited soon.
void prefetch([[maybe_unused]] Span<const Kdop16> bounds, [[maybe_unused]] std::uint64_t key) {
#if defined(__GNUC__)
  const NodePair p = pair_of_key(key);
  __builtin_prefetch(&bounds[p.a]);
  __builtin_prefetch(&bounds[p.b]);
#endif
}

/// Sink of the kernel that stages everything before it is appended.
class StagedSink {
 public:
  struct Targets {
    AppendView<std::uint64_t> triangle_pairs, kept, rested, sprouted, pending;
  };
  StagedSink(const Targets& t, AppendLock lock)
      : triangle_pairs_(t.triangle_pairs, lock),
        kept_(t.kept, lock),
        rested_(t.rested, lock),
        sprouted_(t.sprouted, lock),
        pending_(t.pending, lock) {}

  void sprout(std::size_t index) { sprouted_.append(index); }
  void keep(std::uint64_t key) { kept_.append(key); }
  void rest(std::uint64_t key) { rested_.append(key); }
  void triangle_pair(std::uint64_t key) { triangle_pairs_.append(key); }
  void pend(std::uint64_t key) { pending_.append(key); }

 private:
  StagedAppend<std::uint64_t> triangle_pairs_, kept_, rested_, sprouted_, pending_;
};

}  // namespace

Front::Front(std::size_t initial_capacity, AppendLock lock)
    : lock_(lock),
      triangle_pairs_(initial_capacity),
      kept_(initial_capacity),
      rested_(initial_capacity),
      sprouted_(initial_capacity),
      pending_{AppendBuffer<std::uint64_t>(initial_capacity), AppendBuffer<std::uint64_t>(initial_capacity)} {}

void Front::restart() {
  active_.clear();
  resting_.clear();
  motion_class_.clear();
  fresh_size_ = 0;
}

FrontUpdate Front::update(const FrontInput& input, const Executor& executor) {
  if (fresh_size_ > 0 && excess_ > kFrontRestartShare * fresh_size_) restart();
  const Span<const std::uint32_t> classes = input.motion_class;
  if (motion_class_.size() != classes.size() || !std::equal(classes.begin(), classes.end(), motion_class_.begin())) {
    motion_class_.assign(classes.begin(), classes.end());
    separate_resting(input);
    fresh_size_ = 0;
  }
  const auto node_count = static_cast<NodeIndex>(input.bounds.size());
  if (size() == 0 && input.tree.top_begin < node_count) active_.push_back(pair_key(node_count - 1, node_count - 1));

  const FrontUpdate result = sprout(input, executor);
  replace_sprouted();
  const Span<const std::uint64_t> rested = rested_.values();
  resting_.insert(resting_.end(), rested.begin(), rested.end());
  radix_sort(triangle_pairs_.values(), scratch_);
  if (fresh_size_ == 0) {
    fresh_size_ = std::max<std::size_t>(active_.size(), 1);
    excess_ = 0;
  }
  excess_ += active_.size() - std::min(active_.size(), fresh_size_);
  return result;
}

void Front::separate_resting(const FrontInput& input) {
  const auto rests = [&](std::uint64_t key) {
    const NodePair p = pair_of_key(key);
    if (input.tree.is_top(p.a) || input.tree.is_top(p.b)) return false;
    return motion_class_[input.tree.component_of[p.a]] == motion_class_[input.tree.component_of[p.b]];
  };
  active_.insert(active_.end(), resting_.begin(), resting_.end());
  const auto middle = std::partition(active_.begin(), active_.end(), [&](std::uint64_t key) { return !rests(key); });
  resting_.assign(middle, active_.end());
  active_.erase(middle, active_.end());
}

FrontUpdate Front::sprout(const FrontInput& input, const Executor& executor) {
  FrontUpdate result;
  FrontSproutKernel kernel{input.tree, input.bounds, input.motion_class, {}};
  while (true) {
    StagedSink::Targets targets{triangle_pairs_.start(), kept_.start(), rested_.start(), sprouted_.start(),
                                pending_[0].start()};
    kernel.items = active_;
    executor.for_each_range(active_.size(), kNodesPerRange, [&](std::size_t begin, std::size_t end) {
      StagedSink sink(targets, lock_);
      for (std::size_t i = begin; i < end; ++i) {
        prefetch(input.bounds, active_[std::min(i + kPrefetchDistance, end - 1)]);
        kernel.sprout_node(i, sink);
      }
    });
    ++result.rounds;
    int current = 0;
    while (!pending_[current].overflowed() && pending_[current].needed() > 0) {
      kernel.items = pending_[current].values();
      current = 1 - current;
      targets.pending = pending_[current].start();
      executor.for_each_range(kernel.items.size(), kPendingPerRange, [&](std::size_t begin, std::size_t end) {
        StagedSink sink(targets, lock_);
        for (std::size_t i = begin; i < end; ++i) kernel.resume(i, sink);
      });
      ++result.rounds;
    }
    if (!grow_full_buffers()) return result;
    ++result.replays;
  }
}

bool Front::grow_full_buffers() {
  bool grown = false;
  for (AppendBuffer<std::uint64_t>* buffer :
       {&triangle_pairs_, &kept_, &rested_, &sprouted_, &pending_[0], &pending_[1]}) {
    if (!buffer->overflowed()) continue;
    buffer->grow();
    grown = true;
  }
  return grown;
}

void Front::replace_sprouted() {
  const Span<const std::uint64_t> kept = kept_.values();
  const Span<std::uint64_t> sprouted = sprouted_.values();
  const std::size_t in_place = std::min(kept.size(), sprouted.size());
  for (std::size_t i = 0; i < in_place; ++i) active_[sprouted[i]] = kept[i];
  active_.insert(active_.end(), kept.begin() + in_place, kept.end());
  // More nodes were sprouted than added (all below them rest): the last nodes fill the holes, the highest hole first.
  std::sort(sprouted.begin() + in_place, sprouted.end(), std::greater<>());
  for (std::size_t i = in_place; i < sprouted.size(); ++i) {
    active_[sprouted[i]] = active_.back();
    active_.pop_back();
  }
}

}  // namespace dismantle
