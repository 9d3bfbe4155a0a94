// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/candidates/straight_kernels.h"
#include "dismantle/exec/device_array.h"

#include <algorithm>
#include <utility>

namespace dismantle {

/// Runs the kernels of straight_kernels.h, with arrays that are kept from call to call.
/// @tparam Queue the device: HostQueue or CudaQueue
template <class Queue>
class StraightSweep {
 public:
  /// @param most_pairs room for near pairs that are tested together, if more than a candidate's
  explicit StraightSweep(Queue& queue, std::size_t most_pairs = 1 << 22) : most_pairs_(most_pairs), left_(queue, 1) {}

  /// Finds the first contacts of translations. @param displacements on the device [mm, world]
  /// @param found output, one for each displacement
  void run(Queue& queue, const CandidateScene& scene, const NearLists& lists, Span<const Vec3> displacements,
           Span<CandidateContact> found);

 private:
  // Pairs of a candidate that a round tests: 1 in the first, then more and more, as contacts hardly get earlier.
  static constexpr std::uint32_t kRoundGrowth = 4, kLargestRound = 1024;

  Span<const std::uint64_t> sorted_by_direction(Queue& queue, Span<const Vec3> displacements);
  void clear_left(Queue& queue);
  std::size_t counted_left(Queue& queue);

  std::size_t most_pairs_;
  DeviceArray<std::uint64_t> keys_, sorted_;
  DeviceArray<std::byte> sort_scratch_;
  DeviceArray<SoonestPairs> soonest_;
  DeviceArray<std::uint32_t> next_, undecided_[2];
  DeviceArray<std::uint32_t> counts_;
  DeviceArray<EarlierPair> pairs_;
  MirroredArray<std::uint64_t> left_;  // one: candidates that are undecided after a round
};

template <class Queue>
void StraightSweep<Queue>::run(Queue& queue, const CandidateScene& scene, const NearLists& lists,
                               Span<const Vec3> displacements, Span<CandidateContact> found) {
  const std::size_t count = displacements.size();
  if (count == 0) return;
  const StraightBatch batch{scene, lists, displacements, sorted_by_direction(queue, displacements)};
  const Span<SoonestPairs> soonest = room_for(queue, soonest_, count);
  const Span<std::uint32_t> next = room_for(queue, next_, count);
  Span<std::uint32_t> undecided = room_for(queue, undecided_[0], count);
  Span<std::uint32_t> unfinished = room_for(queue, undecided_[1], count);
  std::uint64_t* const left_count = left_.on_device().data();

  clear_left(queue);
  queue.launch(count, FindSoonest{batch, soonest});
  queue.launch(count, TestSoonest{batch, soonest, found, next, {undecided, left_count}});
  std::uint32_t each = 1;
  for (std::size_t open = counted_left(queue); open > 0; open = counted_left(queue)) {
    const std::size_t together = std::min<std::size_t>(open, std::max<std::size_t>(1, most_pairs_ / each));
    const Span<EarlierPair> pairs = room_for(queue, pairs_, together * each);
    const Span<std::uint32_t> counts = room_for(queue, counts_, together);
    clear_left(queue);
    for (std::size_t begin = 0; begin < open; begin += together) {
      const Span<const std::uint32_t> part = undecided.subspan(begin, std::min(together, open - begin));
      queue.launch(part.size(),
                   ListEarlier{batch, part, soonest, found, each, next, pairs, counts, {unfinished, left_count}});
      queue.launch(part.size() * each, TestEarlier{batch, each, counts, pairs});
      queue.launch(part.size(), TakeEarliest{part, each, counts, pairs, found});
    }
    std::swap(undecided, unfinished);
    each = std::min(kRoundGrowth * each, kLargestRound);
  }
  queue.launch(count, SweepFar{batch, found});
}

template <class Queue>
Span<const std::uint64_t> StraightSweep<Queue>::sorted_by_direction(Queue& queue, Span<const Vec3> displacements) {
  const std::size_t count = displacements.size(), scratch_bytes = queue.sort_scratch_bytes(count);
  const Span<std::uint64_t> keys = room_for(queue, keys_, count), sorted = room_for(queue, sorted_, count);
  queue.launch(count, KeyDirections{displacements, keys});
  queue.sort(keys, sorted, KeyDirections::kBits, room_for(queue, sort_scratch_, scratch_bytes));
  return sorted;
}

template <class Queue>
void StraightSweep<Queue>::clear_left(Queue& queue) {
  left_.on_host()[0] = 0;
  left_.copy_up(queue);
}

template <class Queue>
std::size_t StraightSweep<Queue>::counted_left(Queue& queue) {
  left_.copy_down(queue);
  queue.wait();
  return left_.on_host()[0];
}

}  // namespace dismantle
