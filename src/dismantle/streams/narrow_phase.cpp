// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/narrow_phase.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace dismantle {

namespace {

/// Triangle pairs in one task: a pair takes 0.05 to 1 us.
constexpr std::size_t kPairsPerRange = 64;

/// Sink of the kernel that stages everything before it is appended.
class StagedSink {
 public:
  StagedSink(AppendView<TrianglePairContact> contacts, AppendView<std::uint64_t> intersections,
             std::atomic<std::size_t>& tests, AppendLock lock)
      : contacts_(contacts, lock), intersections_(intersections, lock), tests_(tests) {}
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

/// The time of the step after which contacts do not matter, if these are known.
double horizon(Span<const TrianglePairContact> contacts) {
  double first = 1;
  for (const TrianglePairContact& contact : contacts) first = std::min(first, contact.toi);
  return horizon_after(first);
}

}  // namespace

NarrowPhaseKernel narrow_phase_kernel(const NarrowPhaseInput& input) {
  const MovingStreams& streams = *input.streams;
  return {input.triangle_pairs,
          step_triangles(streams),
          {input.ghosts->displaced, input.ghosts->margins, streams.state(), streams.next()},
          streams.bounds(),
          streams.fixed().bvh.component_of,
          streams.fixed().features,
          input.rules,
          input.test};
}

void NarrowPhase::run(const NarrowPhaseInput& input, const Executor& executor) {
  NarrowPhaseKernel kernel = narrow_phase_kernel(input);
  found_.clear();
  intersecting_.clear();
  tests_ = replays_ = 0;
  const std::size_t count = input.triangle_pairs.size();
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    end = std::min(count, narrow_phase_round_end(begin));
    kernel.pairs = input.triangle_pairs.subspan(begin, end - begin);
    kernel.horizon = horizon(found_);
    run_round(kernel, executor);
  }
}

void NarrowPhase::run_round(const NarrowPhaseKernel& kernel, const Executor& executor) {
  while (true) {
    std::atomic<std::size_t> tests{0};
    const AppendView<TrianglePairContact> contacts = contacts_.start();
    const AppendView<std::uint64_t> intersections = intersections_.start();
    executor.for_each_range(kernel.pairs.size(), kPairsPerRange, [&](std::size_t begin, std::size_t end) {
      StagedSink sink(contacts, intersections, tests, lock_);
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

std::optional<std::vector<TrianglePairContact>> contacts_after(const PartingPair& parting,
                                                               const NarrowPhaseKernel& kernel,
                                                               const Executor& executor) {
  const std::vector<std::uint64_t>& pairs = parting.triangle_pairs;
  if (pairs.empty()) return std::vector<TrianglePairContact>();
  AppendBuffer<TrianglePairContact> contacts(pairs.size());  // at most one a pair
  for (double from = parting.from; from < 1; from += parting.interval) {
    const AppendView<TrianglePairContact> view = contacts.start();
    std::atomic<bool> meets{false};  // at `from` itself
    executor.for_each_range(pairs.size(), kPairsPerRange, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end && !meets.load(std::memory_order_relaxed); ++i) {
        const CcdResult ccd = kernel.certified(pair_of_key(pairs[i]), {}, from, 1);
        if (ccd.status == CcdStatus::Free) continue;
        if (ccd.toi == 0) meets = true;
        view.append({pairs[i], from + (1 - from) * ccd.toi});
      }
    });
    if (!meets) return std::vector<TrianglePairContact>(contacts.values().begin(), contacts.values().end());
  }
  return std::nullopt;
}

StepTriangles step_triangles(const MovingStreams& streams) {
  return {streams.vertices_t0(), streams.vertices_t1(), streams.fixed().faces};
}

std::vector<TrianglePairContact> first_of(Span<const TrianglePairContact> contacts) {
  const double last = horizon(contacts);
  std::vector<TrianglePairContact> first;
  std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(first),
               [&](const TrianglePairContact& contact) { return contact.toi <= last; });
  return first;
}

std::vector<BlockingPair> blocking_pairs(const AssemblyTriangles& streams, Span<const TrianglePairContact> contacts) {
  std::vector<BlockingPair> result;
  for (const TrianglePairContact& found : contacts) {
    const NodePair p = pair_of_key(found.key);
    result.push_back({ComponentId(streams.bvh.component_of[p.a]), ComponentId(streams.bvh.component_of[p.b]),
                      streams.face_of[p.a], streams.face_of[p.b], found.toi});
  }
  return result;
}

std::vector<BlockingPair> first_of(std::vector<BlockingPair> pairs) {
  double first = 1;
  for (const BlockingPair& pair : pairs) first = std::min(first, pair.toi);
  std::erase_if(pairs, [&](const BlockingPair& pair) { return pair.toi > horizon_after(first); });
  std::sort(pairs.begin(), pairs.end(), [](const BlockingPair& x, const BlockingPair& y) {
    if (x.a != y.a) return x.a < y.a;
    if (x.b != y.b) return x.b < y.b;
    return x.face_a != y.face_a ? x.face_a < y.face_a : x.face_b < y.face_b;
  });
  return pairs;
}

}  // namespace dismantle
