// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/device/device_front_kernels.h"
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/exec/device_array.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

/// Fronts in a device's memory. Pages that changed go up; the pairs that do not hold come down, with what separates
/// them. A sweep is one recording of launches that is run whole, and one wait; it is run again where something was
/// full, and goes on where pairs are to be split more often than the recording does.
///
/// `Queue` is the device: HostQueue or CudaQueue. Nothing here knows which. Nor what an elementary test is: `Leaves`
/// says so. It has the types `Sweep`, which tests pairs of triangles of a sweep, `Kernel`, the same in the device's
/// memory, whose test(moving, fixed, hint, horizon) gives a `Found`, and kernel(queue, sweep), which makes it.
template <class Queue, class Leaves>
class DeviceFronts {
 public:
  using Asked = FrontQuery<typename Leaves::Sweep>;
  using Kernel = typename Leaves::Kernel;
  using Found = typename Leaves::Found;

  /// @param capacity that everything starts with
  DeviceFronts(Queue queue, std::size_t capacity);

  /// Checks all certificates of the fronts, and so on: see FrontDevice::ask().
  /// @return of each part, front by front; holds until the next call
  Span<const PartResults> ask(Span<const Asked> fronts, bool to_the_end);
  /// Separates pairs of nodes as boxes: see FrontDevice::separate().
  Span<const NodeSeparation> separate(Span<const Asked> fronts, Span<const MergeCandidate> pairs);
  /// What elementary tests found in that: PairResult::leaf is an index of these.
  Span<const Found> leaves() const { return found_leaves_.on_host().subspan(0, stored_leaves()); }

 private:
  struct Tree {
    DeviceArray<ObbNode> nodes;
    DeviceArray<NormalCone> cones;
    DeviceArray<TriangleF> triangles;
  };
  /// The places of the pages of each part of a front.
  using PartPages = std::vector<std::vector<std::uint32_t>>;

  static constexpr int kRounds = 6;  // of a recording
  static constexpr std::size_t kReportedAnswers = 512;
  static constexpr std::size_t kReportedLeaves = 128;
  static constexpr std::size_t kMaxPairs = std::size_t{1} << 18;   // 60 MB; more is left to the host
  static constexpr std::size_t kMaxLeaves = std::size_t{1} << 17;  // 20 MB

  const device_front::SweepCounters& counters() const { return counters_.on_host()[0]; }
  std::size_t stored() const { return std::min<std::size_t>(counters().needed, pairs_.size()); }
  std::size_t stored_leaves() const { return std::min<std::size_t>(counters().leaves_needed, asked_leaves_.size()); }
  device_front::PairSink sink() { return {pairs_.view(), answers_.on_device(), &counters_.on_device().data()->needed}; }
  device_front::LeafSink leaf_sink() { return {asked_leaves_.view(), &counters_.on_device().data()->leaves_needed}; }

  ObbTreeView tree(const ObbTree& tree);
  device_front::FrontOrder order_of(const Asked& asked);
  void order(Span<const Asked> fronts);
  void order_part(CertificatePart& part, std::vector<std::uint32_t>& pages);
  void send_order();
  std::uint32_t new_page();
  void drop_pages(std::vector<std::uint32_t>& pages, std::size_t count);
  void run(bool to_the_end);
  void enqueue_sweep();
  void enqueue_rounds();
  bool grow();
  void make_pair_room(std::size_t count);
  void make_leaf_room(std::size_t count);
  void collect();
  template <class T>
  void bring_rest(MirroredArray<T>& array, std::size_t brought, std::size_t count);
  template <class T>
  void make_room(MirroredArray<T>& array, std::size_t count);

  Queue queue_;
  Leaves leaves_;
  std::map<const ObbTree*, Tree> trees_;
  std::map<const CertificateFront*, PartPages> part_pages_;
  std::vector<std::uint32_t> free_pages_;
  std::uint32_t page_count_ = 0, pages_sent_ = 0;

  // What the host says of a sweep.
  std::vector<device_front::FrontOrder> orders_;
  std::vector<Kernel> leaf_kernels_;
  std::vector<device_front::CheckedPage> checked_;
  std::vector<device_front::PageEdit> edits_;
  std::size_t part_count_ = 0;

  DeviceArray<device_front::Page> pages_;
  MirroredArray<device_front::FrontOrder> fronts_;
  MirroredArray<Kernel> kernels_;
  MirroredArray<device_front::CheckedPage> checked_pages_;
  MirroredArray<device_front::PageEdit> page_edits_;
  MirroredArray<device_front::SweepOrder> order_;
  MirroredArray<device_front::SweepCounters> counters_;
  MirroredArray<std::uint64_t> least_;
  DeviceArray<device_front::AskedPair> pairs_;
  MirroredArray<PairResult> answers_;
  DeviceArray<device_front::TrianglePairRequest> asked_leaves_;
  MirroredArray<Found> found_leaves_;
  MirroredArray<MergeCandidate> parents_;
  MirroredArray<NodeSeparation> parent_separations_;
  typename Queue::Recording recording_;

  std::vector<PartResults> found_;
};

template <class Queue, class Leaves>
DeviceFronts<Queue, Leaves>::DeviceFronts(Queue queue, std::size_t capacity)
    : queue_(std::move(queue)),
      pages_(queue_, std::max<std::size_t>(capacity, 1)),
      fronts_(queue_, 1),
      kernels_(queue_, 1),
      checked_pages_(queue_, pages_.size()),
      page_edits_(queue_, pages_.size()),
      order_(queue_, 1),
      counters_(queue_, 1),
      least_(queue_, 1),
      pairs_(queue_, 0),
      answers_(queue_, 0),
      found_leaves_(queue_, 0),
      parents_(queue_, 1),
      parent_separations_(queue_, 1) {
  make_pair_room(pages_.size());
  make_leaf_room(pages_.size());
}

/// What is brought down has to be something.
template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::make_pair_room(std::size_t count) {
  pairs_ = DeviceArray<device_front::AskedPair>(queue_, count);
  answers_ = MirroredArray<PairResult>(queue_, count);
  std::fill(answers_.on_host().begin(), answers_.on_host().end(), PairResult{});
  answers_.copy_up(queue_);
  queue_.wait();
  recording_.forget();
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::make_leaf_room(std::size_t count) {
  asked_leaves_ = DeviceArray<device_front::TrianglePairRequest>(queue_, count);
  found_leaves_ = MirroredArray<Found>(queue_, count);
  std::fill(found_leaves_.on_host().begin(), found_leaves_.on_host().end(), Found{});
  found_leaves_.copy_up(queue_);
  queue_.wait();
  recording_.forget();
}

template <class Queue, class Leaves>
Span<const PartResults> DeviceFronts<Queue, Leaves>::ask(Span<const Asked> fronts, bool to_the_end) {
  order(fronts);
  send_order();
  run(to_the_end);
  collect();
  return found_;
}

template <class Queue, class Leaves>
ObbTreeView DeviceFronts<Queue, Leaves>::tree(const ObbTree& tree) {
  auto known = trees_.find(&tree);
  if (known == trees_.end())
    known = trees_
                .emplace(&tree, Tree{DeviceArray<ObbNode>(queue_, Span<const ObbNode>(tree.nodes)),
                                     DeviceArray<NormalCone>(queue_, Span<const NormalCone>(tree.cones)),
                                     DeviceArray<TriangleF>(queue_, Span<const TriangleF>(tree.triangles))})
                .first;
  const Tree& copy = known->second;
  return {copy.nodes.view().data(), copy.cones.view().data(), copy.triangles.view().data()};
}

template <class Queue, class Leaves>
Span<const NodeSeparation> DeviceFronts<Queue, Leaves>::separate(Span<const Asked> fronts,
                                                                 Span<const MergeCandidate> pairs) {
  const std::size_t count = pairs.size();
  make_room(fronts_, fronts.size());
  make_room(parents_, count);
  make_room(parent_separations_, count);
  std::transform(fronts.begin(), fronts.end(), fronts_.on_host().begin(),
                 [this](const Asked& asked) { return order_of(asked); });
  std::copy(pairs.begin(), pairs.end(), parents_.on_host().begin());
  fronts_.copy_up(queue_);
  const Span<MergeCandidate> parents = parents_.on_device().subspan(0, count);
  const Span<NodeSeparation> separations = parent_separations_.on_device().subspan(0, count);
  queue_.copy_up(parents.data(), parents_.on_host().data(), count * sizeof(MergeCandidate));
  queue_.launch(count, device_front::SeparateParents{parents, fronts_.on_device(), separations});
  queue_.copy_down(parent_separations_.on_host().data(), separations.data(), count * sizeof(NodeSeparation));
  queue_.wait();
  return parent_separations_.on_host().subspan(0, count);
}

template <class Queue, class Leaves>
device_front::FrontOrder DeviceFronts<Queue, Leaves>::order_of(const Asked& asked) {
  PairedTrees trees = asked.front->trees();
  trees.a = tree(asked.front->tree_a());
  trees.b = tree(asked.front->tree_b());
  return {*asked.sweep, trees, asked.leaves ? 1u : 0u};
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::order(Span<const Asked> fronts) {
  orders_.clear();
  leaf_kernels_.clear();
  checked_.clear();
  edits_.clear();
  part_count_ = 0;
  for (const Asked& asked : fronts) {
    CertificateFront& front = *asked.front;
    orders_.push_back(order_of(asked));
    leaf_kernels_.push_back(asked.leaves ? leaves_.kernel(queue_, *asked.leaves) : Kernel{});
    PartPages& pages = part_pages_[&front];
    for (std::size_t p = front.part_count(); p < pages.size(); ++p) drop_pages(pages[p], 0);
    pages.resize(front.part_count());
    for (std::size_t p = 0; p < front.part_count(); ++p) {
      order_part(front.part(p), pages[p]);
      ++part_count_;
    }
  }
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::order_part(CertificatePart& part, std::vector<std::uint32_t>& pages) {
  constexpr std::size_t kBlock = CertificateBlocks::kBlock;
  const std::size_t count = part.block_count();
  drop_pages(pages, count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * kBlock, of_page = std::min(kBlock, part.size() - begin);
    const bool is_new = k == pages.size();
    if (is_new) pages.push_back(new_page());
    if (part.take_changed(k) || is_new) {
      device_front::PageEdit& edit = edits_.emplace_back();
      std::copy_n(part.blocks().data + CertificateBlocks::place(begin, 0), device_front::EditPages::kItems,
                  edit.content.fields);
      for (std::size_t i = 0; i < kBlock; ++i) edit.content.pairs[i] = part.pair(begin + std::min(i, of_page - 1));
      edit.page = pages[k];
    }
    checked_.push_back({pages[k], static_cast<std::uint32_t>(orders_.size() - 1),
                        static_cast<std::uint32_t>(part_count_), static_cast<std::uint32_t>(begin),
                        static_cast<std::uint32_t>(of_page)});
  }
}

template <class Queue, class Leaves>
std::uint32_t DeviceFronts<Queue, Leaves>::new_page() {
  if (free_pages_.empty()) return page_count_++;
  const std::uint32_t page = free_pages_.back();
  free_pages_.pop_back();
  return page;
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::drop_pages(std::vector<std::uint32_t>& pages, std::size_t count) {
  for (; pages.size() > count; pages.pop_back()) free_pages_.push_back(pages.back());
}

template <class Queue, class Leaves>
template <class T>
void DeviceFronts<Queue, Leaves>::make_room(MirroredArray<T>& array, std::size_t count) {
  if (count <= array.on_host().size()) return;
  array = MirroredArray<T>(queue_, count + count / 2);
  recording_.forget();
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::send_order() {
  if (page_count_ > pages_.size()) {
    DeviceArray<device_front::Page> larger(queue_, page_count_ + page_count_ / 2);
    queue_.copy(larger.view().data(), pages_.view().data(), pages_sent_ * sizeof(device_front::Page));
    queue_.wait();
    pages_ = std::move(larger);
    recording_.forget();
  }
  make_room(fronts_, orders_.size());
  make_room(kernels_, leaf_kernels_.size());
  make_room(checked_pages_, checked_.size());
  make_room(page_edits_, edits_.size());
  make_room(least_, part_count_);
  std::copy(orders_.begin(), orders_.end(), fronts_.on_host().begin());
  std::copy(leaf_kernels_.begin(), leaf_kernels_.end(), kernels_.on_host().begin());
  std::copy(checked_.begin(), checked_.end(), checked_pages_.on_host().begin());
  std::copy(edits_.begin(), edits_.end(), page_edits_.on_host().begin());
  order_.on_host()[0] = {static_cast<std::uint32_t>(checked_.size())};

  const Span<device_front::PageEdit> edits = page_edits_.on_device().subspan(0, edits_.size());
  queue_.copy_up(edits.data(), page_edits_.on_host().data(), edits.size() * sizeof(device_front::PageEdit));
  queue_.launch(edits.size() * device_front::EditPages::kItems, device_front::EditPages{edits, pages_.view()});
  pages_sent_ = page_count_;
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::run(bool to_the_end) {
  for (bool again = true; again;) {
    queue_.replay(recording_, [this] { enqueue_sweep(); });
    queue_.wait();
    again = grow();
    while (!again && to_the_end && counters().end < stored()) {
      enqueue_rounds();
      queue_.wait();
      again = grow();
    }
  }
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::enqueue_sweep() {
  fronts_.copy_up(queue_);
  kernels_.copy_up(queue_);
  checked_pages_.copy_up(queue_);
  order_.copy_up(queue_);
  queue_.launch(least_.on_host().size(), device_front::BeginSweep{counters_.on_device().data(), least_.on_device()});
  queue_.launch(checked_pages_.on_host().size() * CertificateBlocks::kBlock,
                device_front::CheckCertificates{order_.on_device().data(), checked_pages_.on_device(), pages_.view(),
                                                fronts_.on_device(), least_.on_device(), sink()});
  enqueue_rounds();
  least_.copy_down(queue_);
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::enqueue_rounds() {
  for (int round = 0; round < kRounds; ++round) {
    queue_.launch(1, device_front::NextRound{counters_.on_device().data(), pairs_.size()});
    queue_.launch(pairs_.size(),
                  device_front::SeparatePairs{counters_.on_device().data(), fronts_.on_device(), sink(), leaf_sink()});
  }
  queue_.launch(1, device_front::NextLeaves{counters_.on_device().data(), asked_leaves_.size()});
  queue_.launch(asked_leaves_.size(),
                device_front::TestLeaves<Kernel, Found>{counters_.on_device().data(), asked_leaves_.view(),
                                                        kernels_.on_device(), found_leaves_.on_device()});
  counters_.copy_down(queue_);
  queue_.copy_down(answers_.on_host().data(), answers_.on_device().data(),
                   std::min(kReportedAnswers, pairs_.size()) * sizeof(PairResult));
  queue_.copy_down(found_leaves_.on_host().data(), found_leaves_.on_device().data(),
                   std::min(kReportedLeaves, found_leaves_.on_host().size()) * sizeof(Found));
}

/// Makes room where there was not enough. True where it made some: then the sweep must be run again.
template <class Queue, class Leaves>
bool DeviceFronts<Queue, Leaves>::grow() {
  const auto room_for = [](std::size_t needed, std::size_t room, std::size_t most) {
    return needed <= room || room >= most ? room : std::min(needed + needed / 2, most);
  };
  // All that do not hold have to be known.
  const std::size_t most = std::max(kMaxPairs, checked_.size() * CertificateBlocks::kBlock);
  const std::size_t pairs = room_for(counters().needed, pairs_.size(), most);
  const std::size_t leaves = room_for(counters().leaves_needed, asked_leaves_.size(), kMaxLeaves);
  const bool grows = pairs > pairs_.size() || leaves > asked_leaves_.size();
  if (pairs > pairs_.size()) make_pair_room(pairs);
  if (leaves > asked_leaves_.size()) make_leaf_room(leaves);
  return grows;
}

/// Brings down what did not come with the counts.
template <class Queue, class Leaves>
template <class T>
void DeviceFronts<Queue, Leaves>::bring_rest(MirroredArray<T>& array, std::size_t brought, std::size_t count) {
  if (count <= brought) return;
  queue_.copy_down(array.on_host().data() + brought, array.on_device().data() + brought, (count - brought) * sizeof(T));
  queue_.wait();
}

template <class Queue, class Leaves>
void DeviceFronts<Queue, Leaves>::collect() {
  const std::size_t count = stored();
  bring_rest(answers_, kReportedAnswers, count);
  bring_rest(found_leaves_, kReportedLeaves, stored_leaves());
  const Span<const PairResult> answers(answers_.on_host().data(), count);
  found_.assign(part_count_, {});
  for (std::size_t p = 0; p < part_count_; ++p) {
    found_[p].min_gap = device_front::gap_of_word(least_.on_host()[p]);
    found_[p].answers = answers;
  }
  for (std::uint32_t k = 0; k < count; ++k)
    if (answers[k].place != PairResult::kNone) found_[answers[k].part].roots.push_back(k);
  for (PartResults& part : found_)
    std::sort(part.roots.begin(), part.roots.end(),
              [&](std::uint32_t x, std::uint32_t y) { return answers[x].place < answers[y].place; });
}

}  // namespace dismantle
