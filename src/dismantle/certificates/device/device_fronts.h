// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/device/device_front_kernels.h"
#include "dismantle/certificates/device/device_solids.h"
#include "dismantle/certificates/device/front_device.h"
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/exec/device_array.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

/// Copies of fronts in the memory of the device that `Queue` is: HostQueue or CudaQueue. Pages that have changed are
/// uploaded; the pairs whose certificates do not hold are downloaded, with what separates them. A sweep is one recorded
/// sequence of launches and one wait; it is repeated if a buffer was full, and continued if pairs have to be split more
/// often than the recording does.
template <class Queue>
class DeviceFronts final : public FrontDevice {
 public:
  /// @param capacity initial size of the buffers
  DeviceFronts(Queue queue, std::size_t capacity);

  Span<const PartResults> evaluate(Span<const FrontQuery> fronts, bool exhaustive) override;
  Span<const NodeSeparation> separate(Span<const FrontQuery> fronts, Span<const MergeCandidate> pairs) override;

 private:
  struct Tree {
    DeviceArray<ObbNode> nodes;
    DeviceArray<TriangleF> triangles;
  };
  /// The pages of each part of a front.
  using PartPages = std::vector<std::vector<std::uint32_t>>;

  static constexpr int kRounds = 6;  // of a recording
  static constexpr std::size_t kReportedPairs = 512;
  static constexpr std::size_t kReportedTests = 128;
  static constexpr std::size_t kMaxPairs = std::size_t{1} << 18;  // 60 MB; more are left to the host
  static constexpr std::size_t kMaxTests = std::size_t{1} << 17;  // 20 MB

  const device_front::SweepCounters& counters() const { return counters_.on_host()[0]; }
  std::size_t stored_pairs() const { return std::min<std::size_t>(counters().needed, pairs_.size()); }
  std::size_t stored_tests() const { return std::min<std::size_t>(counters().tests_needed, requests_.size()); }
  device_front::PairSink pair_sink() {
    return {pairs_.view(), results_.on_device(), &counters_.on_device().data()->needed};
  }
  device_front::TestSink test_sink() { return {requests_.view(), &counters_.on_device().data()->tests_needed}; }

  /// The tree in the device's memory; uploads it the first time.
  ObbTreeView tree(const ObbTree& tree);
  device_front::QueriedFront queried(const FrontQuery& query);
  /// Gathers the fronts, pages and edits of a sweep on the host.
  void gather(Span<const FrontQuery> fronts);
  void gather_part(CertificatePart& part, std::vector<std::uint32_t>& pages);
  void upload();
  std::uint32_t new_page();
  void drop_pages(std::vector<std::uint32_t>& pages, std::size_t count);
  void run(bool exhaustive);
  void enqueue_sweep();
  void enqueue_rounds();
  /// Enlarges the buffers that were full. @return true if any was: the sweep has to be repeated
  bool grow();
  void make_pair_room(std::size_t count);
  void make_test_room(std::size_t count);
  void collect();
  /// Downloads the elements that the recording did not.
  template <class T>
  void download_rest(MirroredArray<T>& array, std::size_t downloaded, std::size_t count);
  template <class T>
  void make_room(MirroredArray<T>& array, std::size_t count);

  Queue queue_;
  DeviceSolids solids_;
  std::map<const ObbTree*, Tree> trees_;
  std::map<const CertificateFront*, PartPages> part_pages_;
  std::vector<std::uint32_t> free_pages_;
  std::uint32_t page_count_ = 0, pages_sent_ = 0;

  // The host's side of a sweep.
  std::vector<device_front::QueriedFront> queried_;
  std::vector<TrianglePairSweepKernel> queried_kernels_;
  std::vector<device_front::CheckedPage> checked_;
  std::vector<device_front::PageEdit> edits_;
  std::size_t part_count_ = 0;

  DeviceArray<device_front::Page> pages_;
  MirroredArray<device_front::QueriedFront> fronts_;
  MirroredArray<TrianglePairSweepKernel> kernels_;
  MirroredArray<device_front::CheckedPage> checked_pages_;
  MirroredArray<device_front::PageEdit> page_edits_;
  MirroredArray<device_front::SweepSize> size_;
  MirroredArray<device_front::SweepCounters> counters_;
  MirroredArray<std::uint64_t> min_gaps_;
  DeviceArray<device_front::PendingPair> pairs_;
  MirroredArray<PairResult> results_;
  DeviceArray<device_front::TrianglePairRequest> requests_;
  MirroredArray<TrianglePairResult> tests_;
  MirroredArray<MergeCandidate> candidates_;
  MirroredArray<NodeSeparation> candidate_separations_;
  typename Queue::Recording recording_;

  std::vector<PartResults> part_results_;
};

template <class Queue>
DeviceFronts<Queue>::DeviceFronts(Queue queue, std::size_t capacity)
    : queue_(std::move(queue)),
      pages_(queue_, std::max<std::size_t>(capacity, 1)),
      fronts_(queue_, 1),
      kernels_(queue_, 1),
      checked_pages_(queue_, pages_.size()),
      page_edits_(queue_, pages_.size()),
      size_(queue_, 1),
      counters_(queue_, 1),
      min_gaps_(queue_, 1),
      pairs_(queue_, 0),
      results_(queue_, 0),
      tests_(queue_, 0),
      candidates_(queue_, 1),
      candidate_separations_(queue_, 1) {
  make_pair_room(pages_.size());
  make_test_room(pages_.size());
}

/// Initialises the host's copy too: more is downloaded than a sweep writes.
template <class Queue>
void DeviceFronts<Queue>::make_pair_room(std::size_t count) {
  pairs_ = DeviceArray<device_front::PendingPair>(queue_, count);
  results_ = MirroredArray<PairResult>(queue_, count);
  std::fill(results_.on_host().begin(), results_.on_host().end(), PairResult{});
  results_.copy_up(queue_);
  queue_.wait();
  recording_.forget();
}

template <class Queue>
void DeviceFronts<Queue>::make_test_room(std::size_t count) {
  requests_ = DeviceArray<device_front::TrianglePairRequest>(queue_, count);
  tests_ = MirroredArray<TrianglePairResult>(queue_, count);
  std::fill(tests_.on_host().begin(), tests_.on_host().end(), TrianglePairResult{});
  tests_.copy_up(queue_);
  queue_.wait();
  recording_.forget();
}

template <class Queue>
Span<const PartResults> DeviceFronts<Queue>::evaluate(Span<const FrontQuery> fronts, bool exhaustive) {
  gather(fronts);
  upload();
  run(exhaustive);
  collect();
  return part_results_;
}

template <class Queue>
ObbTreeView DeviceFronts<Queue>::tree(const ObbTree& tree) {
  auto known = trees_.find(&tree);
  if (known == trees_.end())
    known = trees_
                .emplace(&tree, Tree{DeviceArray<ObbNode>(queue_, Span<const ObbNode>(tree.nodes)),
                                     DeviceArray<TriangleF>(queue_, Span<const TriangleF>(tree.triangles))})
                .first;
  const Tree& copy = known->second;
  return {copy.nodes.view().data(), copy.triangles.view().data()};
}

template <class Queue>
Span<const NodeSeparation> DeviceFronts<Queue>::separate(Span<const FrontQuery> fronts,
                                                         Span<const MergeCandidate> pairs) {
  const std::size_t count = pairs.size();
  make_room(fronts_, fronts.size());
  make_room(candidates_, count);
  make_room(candidate_separations_, count);
  std::transform(fronts.begin(), fronts.end(), fronts_.on_host().begin(),
                 [this](const FrontQuery& query) { return queried(query); });
  std::copy(pairs.begin(), pairs.end(), candidates_.on_host().begin());
  fronts_.copy_up(queue_);
  const Span<MergeCandidate> candidates = candidates_.on_device().subspan(0, count);
  const Span<NodeSeparation> separations = candidate_separations_.on_device().subspan(0, count);
  queue_.copy_up(candidates.data(), candidates_.on_host().data(), count * sizeof(MergeCandidate));
  queue_.launch(count, device_front::SeparateCandidates{candidates, fronts_.on_device(), separations});
  queue_.copy_down(candidate_separations_.on_host().data(), separations.data(), count * sizeof(NodeSeparation));
  queue_.wait();
  return candidate_separations_.on_host().subspan(0, count);
}

template <class Queue>
device_front::QueriedFront DeviceFronts<Queue>::queried(const FrontQuery& query) {
  PairedTrees trees = query.front->trees();
  trees.a = tree(query.front->tree_a());
  trees.b = tree(query.front->tree_b());
  return {*query.sweep, trees, query.triangle_pairs ? 1u : 0u};
}

template <class Queue>
void DeviceFronts<Queue>::gather(Span<const FrontQuery> fronts) {
  queried_.clear();
  queried_kernels_.clear();
  checked_.clear();
  edits_.clear();
  part_count_ = 0;
  for (const FrontQuery& query : fronts) {
    CertificateFront& front = *query.front;
    queried_.push_back(queried(query));
    queried_kernels_.push_back(query.triangle_pairs ? solids_.kernel(queue_, *query.triangle_pairs)
                                                    : TrianglePairSweepKernel{});
    PartPages& pages = part_pages_[&front];
    for (std::size_t p = front.part_count(); p < pages.size(); ++p) drop_pages(pages[p], 0);
    pages.resize(front.part_count());
    for (std::size_t p = 0; p < front.part_count(); ++p) {
      gather_part(front.part(p), pages[p]);
      ++part_count_;
    }
  }
}

template <class Queue>
void DeviceFronts<Queue>::gather_part(CertificatePart& part, std::vector<std::uint32_t>& pages) {
  constexpr std::size_t kBlock = CertificateBlocks::kBlock;
  const std::size_t count = part.block_count();
  drop_pages(pages, count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * kBlock, of_page = std::min(kBlock, part.size() - begin);
    const bool is_new = k == pages.size();
    if (is_new) pages.push_back(new_page());
    if (part.take_changed(k) || is_new) {
      device_front::PageEdit& edit = edits_.emplace_back();
      std::copy_n(part.blocks().data + CertificateBlocks::index(begin, 0), device_front::EditPages::kItems,
                  edit.content.fields);
      for (std::size_t i = 0; i < kBlock; ++i) edit.content.pairs[i] = part.pair(begin + std::min(i, of_page - 1));
      edit.page = pages[k];
    }
    checked_.push_back({pages[k], static_cast<std::uint32_t>(queried_.size() - 1),
                        static_cast<std::uint32_t>(part_count_), static_cast<std::uint32_t>(begin),
                        static_cast<std::uint32_t>(of_page)});
  }
}

template <class Queue>
std::uint32_t DeviceFronts<Queue>::new_page() {
  if (free_pages_.empty()) return page_count_++;
  const std::uint32_t page = free_pages_.back();
  free_pages_.pop_back();
  return page;
}

template <class Queue>
void DeviceFronts<Queue>::drop_pages(std::vector<std::uint32_t>& pages, std::size_t count) {
  for (; pages.size() > count; pages.pop_back()) free_pages_.push_back(pages.back());
}

template <class Queue>
template <class T>
void DeviceFronts<Queue>::make_room(MirroredArray<T>& array, std::size_t count) {
  if (count <= array.on_host().size()) return;
  array = MirroredArray<T>(queue_, count + count / 2);
  recording_.forget();
}

template <class Queue>
void DeviceFronts<Queue>::upload() {
  if (page_count_ > pages_.size()) {
    DeviceArray<device_front::Page> larger(queue_, page_count_ + page_count_ / 2);
    queue_.copy(larger.view().data(), pages_.view().data(), pages_sent_ * sizeof(device_front::Page));
    queue_.wait();
    pages_ = std::move(larger);
    recording_.forget();
  }
  make_room(fronts_, queried_.size());
  make_room(kernels_, queried_kernels_.size());
  make_room(checked_pages_, checked_.size());
  make_room(page_edits_, edits_.size());
  make_room(min_gaps_, part_count_);
  std::copy(queried_.begin(), queried_.end(), fronts_.on_host().begin());
  std::copy(queried_kernels_.begin(), queried_kernels_.end(), kernels_.on_host().begin());
  std::copy(checked_.begin(), checked_.end(), checked_pages_.on_host().begin());
  std::copy(edits_.begin(), edits_.end(), page_edits_.on_host().begin());
  size_.on_host()[0] = {static_cast<std::uint32_t>(checked_.size())};

  const Span<device_front::PageEdit> edits = page_edits_.on_device().subspan(0, edits_.size());
  queue_.copy_up(edits.data(), page_edits_.on_host().data(), edits.size() * sizeof(device_front::PageEdit));
  queue_.launch(edits.size() * device_front::EditPages::kItems, device_front::EditPages{edits, pages_.view()});
  pages_sent_ = page_count_;
}

template <class Queue>
void DeviceFronts<Queue>::run(bool exhaustive) {
  for (bool again = true; again;) {
    queue_.replay(recording_, [this] { enqueue_sweep(); });
    queue_.wait();
    again = grow();
    while (!again && exhaustive && counters().end < stored_pairs()) {
      enqueue_rounds();
      queue_.wait();
      again = grow();
    }
  }
}

template <class Queue>
void DeviceFronts<Queue>::enqueue_sweep() {
  fronts_.copy_up(queue_);
  kernels_.copy_up(queue_);
  checked_pages_.copy_up(queue_);
  size_.copy_up(queue_);
  queue_.launch(min_gaps_.on_host().size(),
                device_front::BeginSweep{counters_.on_device().data(), min_gaps_.on_device()});
  queue_.launch(checked_pages_.on_host().size() * CertificateBlocks::kBlock,
                device_front::CheckCertificates{size_.on_device().data(), checked_pages_.on_device(), pages_.view(),
                                                fronts_.on_device(), min_gaps_.on_device(), pair_sink()});
  enqueue_rounds();
  min_gaps_.copy_down(queue_);
}

template <class Queue>
void DeviceFronts<Queue>::enqueue_rounds() {
  for (int round = 0; round < kRounds; ++round) {
    queue_.launch(1, device_front::NextRound{counters_.on_device().data(), pairs_.size()});
    queue_.launch(pairs_.size(), device_front::SeparatePairs{counters_.on_device().data(), fronts_.on_device(),
                                                             pair_sink(), test_sink()});
  }
  queue_.launch(1, device_front::NextTests{counters_.on_device().data(), requests_.size()});
  queue_.launch(requests_.size(), device_front::TestTrianglePairs{counters_.on_device().data(), requests_.view(),
                                                                  kernels_.on_device(), tests_.on_device()});
  counters_.copy_down(queue_);
  queue_.copy_down(results_.on_host().data(), results_.on_device().data(),
                   std::min(kReportedPairs, pairs_.size()) * sizeof(PairResult));
  queue_.copy_down(tests_.on_host().data(), tests_.on_device().data(),
                   std::min(kReportedTests, tests_.on_host().size()) * sizeof(TrianglePairResult));
}

template <class Queue>
bool DeviceFronts<Queue>::grow() {
  const auto room_for = [](std::size_t needed, std::size_t room, std::size_t limit) {
    return needed <= room || room >= limit ? room : std::min(needed + needed / 2, limit);
  };
  // There must be room for all pairs of the fronts: those that do not hold have to be known.
  const std::size_t max_pairs = std::max(kMaxPairs, checked_.size() * CertificateBlocks::kBlock);
  const std::size_t pairs = room_for(counters().needed, pairs_.size(), max_pairs);
  const std::size_t tests = room_for(counters().tests_needed, requests_.size(), kMaxTests);
  const bool grows = pairs > pairs_.size() || tests > requests_.size();
  if (pairs > pairs_.size()) make_pair_room(pairs);
  if (tests > requests_.size()) make_test_room(tests);
  return grows;
}

template <class Queue>
template <class T>
void DeviceFronts<Queue>::download_rest(MirroredArray<T>& array, std::size_t downloaded, std::size_t count) {
  if (count <= downloaded) return;
  queue_.copy_down(array.on_host().data() + downloaded, array.on_device().data() + downloaded,
                   (count - downloaded) * sizeof(T));
  queue_.wait();
}

template <class Queue>
void DeviceFronts<Queue>::collect() {
  const std::size_t count = stored_pairs();
  download_rest(results_, kReportedPairs, count);
  download_rest(tests_, kReportedTests, stored_tests());
  const Span<const PairResult> pairs(results_.on_host().data(), count);
  const Span<const TrianglePairResult> tests(tests_.on_host().data(), stored_tests());
  part_results_.assign(part_count_, {});
  for (std::size_t p = 0; p < part_count_; ++p) {
    part_results_[p].min_gap = device_front::gap_of_word(min_gaps_.on_host()[p]);
    part_results_[p].pairs = pairs;
    part_results_[p].tests = tests;
  }
  for (std::uint32_t k = 0; k < count; ++k)
    if (pairs[k].slot != PairResult::kNone) part_results_[pairs[k].part].roots.push_back(k);
  for (PartResults& part : part_results_)
    std::sort(part.roots.begin(), part.roots.end(),
              [&](std::uint32_t x, std::uint32_t y) { return pairs[x].slot < pairs[y].slot; });
}

}  // namespace dismantle
