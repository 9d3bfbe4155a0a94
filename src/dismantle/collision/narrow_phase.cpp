// SPDX-License-Identifier: Apache-2.0
#include "dismantle/collision/narrow_phase.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace dismantle {

namespace {

constexpr std::size_t kFirstRound = 512;
constexpr std::size_t kRoundGrowth = 4;
constexpr std::size_t kPairsPerRange = 64;  // a pair costs 0.05-1 us

/// Where the kernel's finds go, staged.
class StagedSink {
 public:
  StagedSink(AppendView<TrianglePairContact> contacts, AppendView<std::uint64_t> intersections,
             std::atomic<std::size_t>& tests)
      : contacts_(contacts), intersections_(intersections), tests_(tests) {}
  StagedSink(const StagedSink&) = delete;
  StagedSink& operator=(const StagedSink&) = delete;
  ~StagedSink() { tests_.fetch_add(count_, std::memory_order_relaxed); }

  void contact(const TrianglePairContact& found) { contacts_.append(found); }
  void intersection(std::uint64_t key) { intersections_.append(key); }
  void tested(std::size_t count) { count_ += count; }

 private:
  StagedAppend<TrianglePairContact, 16> contacts_;
  StagedAppend<std::uint64_t> intersections_;
  std::atomic<std::size_t>& tests_;
  std::size_t count_ = 0;
};

StepTriangles step_triangles(const MovingStreams& streams) {
  return {streams.vertices_t0(), streams.vertices_t1(), streams.fixed().faces};
}

}  // namespace

void NarrowPhase::run(const NarrowPhaseInput& input, const Executor& executor) {
  const MovingStreams& streams = *input.streams;
  NarrowPhaseKernel kernel{{},
                           step_triangles(streams),
                           streams.bounds(),
                           streams.fixed().bvh.component_of,
                           streams.fixed().features,
                           streams.motion_class(),
                           input.rules,
                           input.test,
                           input.path_deviation};
  found_.clear();
  intersecting_.clear();
  tests_ = replays_ = 0;
  const std::size_t count = input.triangle_pairs.size();
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    end = std::min(count, begin + std::max(kFirstRound, kRoundGrowth * begin));
    kernel.pairs = input.triangle_pairs.subspan(begin, end - begin);
    kernel.horizon = horizon();
    run_round(kernel, executor);
  }
}

void NarrowPhase::run_round(const NarrowPhaseKernel& kernel, const Executor& executor) {
  while (true) {
    std::atomic<std::size_t> tests{0};
    const AppendView<TrianglePairContact> contacts = contacts_.start();
    const AppendView<std::uint64_t> intersections = intersections_.start();
    executor.for_each_range(kernel.pairs.size(), kPairsPerRange, [&](std::size_t begin, std::size_t end) {
      StagedSink sink(contacts, intersections, tests);
      for (std::size_t i = begin; i < end; ++i) kernel(i, sink);
    });
    if (!contacts_.overflowed() && !intersections_.overflowed()) {
      tests_ += tests;
      break;
    }
    if (contacts_.overflowed()) contacts_.grow();
    if (intersections_.overflowed()) intersections_.grow();
    ++replays_;
  }
  found_.insert(found_.end(), contacts_.values().begin(), contacts_.values().end());
  intersecting_.insert(intersecting_.end(), intersections_.values().begin(), intersections_.values().end());
}

double NarrowPhase::horizon() const {
  double first = 1;
  for (const TrianglePairContact& contact : found_) first = std::min(first, contact.toi);
  return std::min(1.0, first + kContactWindow);
}

std::vector<TrianglePairContact> NarrowPhase::first_contacts() const {
  const double last = horizon();
  std::vector<TrianglePairContact> first;
  std::copy_if(found_.begin(), found_.end(), std::back_inserter(first),
               [&](const TrianglePairContact& contact) { return contact.toi <= last; });
  return first;
}

void NarrowPhase::run_part(const NarrowPhaseInput& input, Span<const std::uint64_t> pairs, double from,
                           const Executor& executor) {
  if (pairs.empty()) return;
  const MovingStreams& streams = *input.streams;
  const StepTriangles triangles = step_triangles(streams);
  const NodePair first = pair_of_key(pairs[0]);
  const std::vector<std::uint32_t>& component_of = streams.fixed().bvh.component_of;
  const bool a_moves = streams.motion_class()[component_of[first.a]] != 0;
  const bool b_moves = streams.motion_class()[component_of[first.b]] != 0;
  const double allowed = allowed_on_chords(input.rules.tolerance, input.path_deviation, a_moves, b_moves);
  const int runs = append_with_replay(contacts_, [&](AppendView<TrianglePairContact> view) {
    executor.for_each_range(pairs.size(), kPairsPerRange, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const NodePair p = pair_of_key(pairs[i]);
        const CcdResult ccd = ccd_triangle_triangle(part_of(triangles.motion(p.a), from, 1),
                                                    part_of(triangles.motion(p.b), from, 1), allowed);
        if (ccd.status == CcdStatus::Contact) view.append({pairs[i], from + (1 - from) * ccd.toi});
      }
    });
  });
  tests_ += pairs.size();
  replays_ += static_cast<std::size_t>(runs - 1);
  const Span<const TrianglePairContact> added = contacts_.values();
  found_.insert(found_.end(), added.begin(), added.end());
}

std::vector<std::uint64_t> NarrowPhase::intersections_of(const NarrowPhaseInput& input, ComponentId a,
                                                         ComponentId b) const {
  std::vector<std::uint64_t> keys = triangle_pairs_of(intersecting_, *input.streams, a, b);
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<std::uint64_t> triangle_pairs_of(Span<const std::uint64_t> triangle_pairs, const MovingStreams& streams,
                                             ComponentId a, ComponentId b) {
  const std::vector<std::uint32_t>& component_of = streams.fixed().bvh.component_of;
  std::vector<std::uint64_t> keys;
  for (const std::uint64_t key : triangle_pairs) {
    const NodePair p = pair_of_key(key);
    if (component_of[p.a] == a.value && component_of[p.b] == b.value) keys.push_back(key);
  }
  return keys;
}

}  // namespace dismantle
