// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/exec/device_array.h"
#include "dismantle/front/certificate_front.h"
#include "dismantle/front/resident_front_kernels.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace dismantle {

/// Fronts in a device's memory. Pages that changed go up; the pairs that do not hold come down, with what separates
/// them. A sweep is one recording of launches that is run whole, and one wait; it is run again where something was
/// full, and goes on where pairs are to be split more often than the recording does.
///
/// `Queue` is the device: HostQueue or CudaQueue. Nothing here knows which.
template <class Queue>
class ResidentFronts final : public FrontDevice {
 public:
  /// @param capacity that everything starts with
  ResidentFronts(Queue queue, std::size_t capacity);

  Span<const PartAnswers> ask(Span<const AskedFront> fronts, bool to_the_end) override;

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
  static constexpr std::size_t kMostPairs = std::size_t{1} << 18;  // 60 MB; more is left to the host

  const resident_front::SweepCounters& counters() const { return counters_.on_host()[0]; }
  std::size_t stored() const { return std::min<std::size_t>(counters().needed, pairs_.size()); }
  resident_front::PairSink sink() {
    return {pairs_.view(), answers_.on_device(), &counters_.on_device().data()->needed};
  }

  ObbTreeView tree(const ObbTree& tree);
  void order(Span<const AskedFront> fronts);
  void order_part(CertificatePart& part, std::vector<std::uint32_t>& pages);
  void send_order();
  std::uint32_t new_page();
  void drop_pages(std::vector<std::uint32_t>& pages, std::size_t count);
  void run(bool to_the_end);
  void enqueue_sweep();
  void enqueue_rounds();
  bool grow();
  void make_pair_room(std::size_t count);
  void collect();
  template <class T>
  void make_room(MirroredArray<T>& array, std::size_t count);

  Queue queue_;
  std::map<const ObbTree*, Tree> trees_;
  std::map<const CertificateFront*, PartPages> part_pages_;
  std::vector<std::uint32_t> free_pages_;
  std::uint32_t page_count_ = 0, pages_sent_ = 0;

  // What the host says of a sweep.
  std::vector<resident_front::FrontOrder> orders_;
  std::vector<resident_front::CheckedPage> checked_;
  std::vector<resident_front::PageEdit> edits_;
  std::size_t part_count_ = 0;

  DeviceArray<resident_front::Page> pages_;
  MirroredArray<resident_front::FrontOrder> fronts_;
  MirroredArray<resident_front::CheckedPage> checked_pages_;
  MirroredArray<resident_front::PageEdit> page_edits_;
  MirroredArray<resident_front::SweepOrder> order_;
  MirroredArray<resident_front::SweepCounters> counters_;
  MirroredArray<std::uint64_t> least_;
  DeviceArray<resident_front::AskedPair> pairs_;
  MirroredArray<PairAnswer> answers_;
  typename Queue::Recording recording_;

  std::vector<PartAnswers> found_;
};

template <class Queue>
ResidentFronts<Queue>::ResidentFronts(Queue queue, std::size_t capacity)
    : queue_(std::move(queue)),
      pages_(queue_, std::max<std::size_t>(capacity, 1)),
      fronts_(queue_, 1),
      checked_pages_(queue_, pages_.size()),
      page_edits_(queue_, pages_.size()),
      order_(queue_, 1),
      counters_(queue_, 1),
      least_(queue_, 1),
      pairs_(queue_, 0),
      answers_(queue_, 0) {
  make_pair_room(pages_.size());
}

/// What is brought down has to be something.
template <class Queue>
void ResidentFronts<Queue>::make_pair_room(std::size_t count) {
  pairs_ = DeviceArray<resident_front::AskedPair>(queue_, count);
  answers_ = MirroredArray<PairAnswer>(queue_, count);
  std::fill(answers_.on_host().begin(), answers_.on_host().end(), PairAnswer{});
  answers_.copy_up(queue_);
  queue_.wait();
  recording_.forget();
}

template <class Queue>
Span<const PartAnswers> ResidentFronts<Queue>::ask(Span<const AskedFront> fronts, bool to_the_end) {
  order(fronts);
  send_order();
  run(to_the_end);
  collect();
  return found_;
}

template <class Queue>
ObbTreeView ResidentFronts<Queue>::tree(const ObbTree& tree) {
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

template <class Queue>
void ResidentFronts<Queue>::order(Span<const AskedFront> fronts) {
  orders_.clear();
  checked_.clear();
  edits_.clear();
  part_count_ = 0;
  for (const AskedFront& asked : fronts) {
    CertificateFront& front = *asked.front;
    PairedTrees trees = front.trees();
    trees.a = tree(front.tree_a());
    trees.b = tree(front.tree_b());
    orders_.push_back({*asked.sweep, trees});
    PartPages& pages = part_pages_[&front];
    for (std::size_t p = front.part_count(); p < pages.size(); ++p) drop_pages(pages[p], 0);
    pages.resize(front.part_count());
    for (std::size_t p = 0; p < front.part_count(); ++p) {
      order_part(front.part(p), pages[p]);
      ++part_count_;
    }
  }
}

template <class Queue>
void ResidentFronts<Queue>::order_part(CertificatePart& part, std::vector<std::uint32_t>& pages) {
  constexpr std::size_t kBlock = CertificateBlocks::kBlock;
  const std::size_t count = part.block_count();
  drop_pages(pages, count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * kBlock, of_page = std::min(kBlock, part.size() - begin);
    const bool is_new = k == pages.size();
    if (is_new) pages.push_back(new_page());
    if (part.take_changed(k) || is_new) {
      resident_front::PageEdit& edit = edits_.emplace_back();
      std::copy_n(part.blocks().data + CertificateBlocks::place(begin, 0), resident_front::EditPages::kItems,
                  edit.content.fields);
      for (std::size_t i = 0; i < kBlock; ++i) edit.content.pairs[i] = part.pair(begin + std::min(i, of_page - 1));
      edit.page = pages[k];
    }
    checked_.push_back({pages[k], static_cast<std::uint32_t>(orders_.size() - 1),
                        static_cast<std::uint32_t>(part_count_), static_cast<std::uint32_t>(begin),
                        static_cast<std::uint32_t>(of_page)});
  }
}

template <class Queue>
std::uint32_t ResidentFronts<Queue>::new_page() {
  if (free_pages_.empty()) return page_count_++;
  const std::uint32_t page = free_pages_.back();
  free_pages_.pop_back();
  return page;
}

template <class Queue>
void ResidentFronts<Queue>::drop_pages(std::vector<std::uint32_t>& pages, std::size_t count) {
  for (; pages.size() > count; pages.pop_back()) free_pages_.push_back(pages.back());
}

template <class Queue>
template <class T>
void ResidentFronts<Queue>::make_room(MirroredArray<T>& array, std::size_t count) {
  if (count <= array.on_host().size()) return;
  array = MirroredArray<T>(queue_, count + count / 2);
  recording_.forget();
}

template <class Queue>
void ResidentFronts<Queue>::send_order() {
  if (page_count_ > pages_.size()) {
    DeviceArray<resident_front::Page> larger(queue_, page_count_ + page_count_ / 2);
    queue_.copy(larger.view().data(), pages_.view().data(), pages_sent_ * sizeof(resident_front::Page));
    queue_.wait();
    pages_ = std::move(larger);
    recording_.forget();
  }
  make_room(fronts_, orders_.size());
  make_room(checked_pages_, checked_.size());
  make_room(page_edits_, edits_.size());
  make_room(least_, part_count_);
  std::copy(orders_.begin(), orders_.end(), fronts_.on_host().begin());
  std::copy(checked_.begin(), checked_.end(), checked_pages_.on_host().begin());
  std::copy(edits_.begin(), edits_.end(), page_edits_.on_host().begin());
  order_.on_host()[0] = {static_cast<std::uint32_t>(checked_.size())};

  const Span<resident_front::PageEdit> edits = page_edits_.on_device().subspan(0, edits_.size());
  queue_.copy_up(edits.data(), page_edits_.on_host().data(), edits.size() * sizeof(resident_front::PageEdit));
  queue_.launch(edits.size() * resident_front::EditPages::kItems, resident_front::EditPages{edits, pages_.view()});
  pages_sent_ = page_count_;
}

template <class Queue>
void ResidentFronts<Queue>::run(bool to_the_end) {
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

template <class Queue>
void ResidentFronts<Queue>::enqueue_sweep() {
  fronts_.copy_up(queue_);
  checked_pages_.copy_up(queue_);
  order_.copy_up(queue_);
  queue_.launch(least_.on_host().size(), resident_front::BeginSweep{counters_.on_device().data(), least_.on_device()});
  queue_.launch(checked_pages_.on_host().size() * CertificateBlocks::kBlock,
                resident_front::CheckCertificates{order_.on_device().data(), checked_pages_.on_device(), pages_.view(),
                                                  fronts_.on_device(), least_.on_device(), sink()});
  enqueue_rounds();
  least_.copy_down(queue_);
}

template <class Queue>
void ResidentFronts<Queue>::enqueue_rounds() {
  for (int round = 0; round < kRounds; ++round) {
    queue_.launch(1, resident_front::NextRound{counters_.on_device().data(), pairs_.size()});
    queue_.launch(pairs_.size(),
                  resident_front::SeparatePairs{counters_.on_device().data(), fronts_.on_device(), sink()});
  }
  counters_.copy_down(queue_);
  queue_.copy_down(answers_.on_host().data(), answers_.on_device().data(),
                   std::min(kReportedAnswers, pairs_.size()) * sizeof(PairAnswer));
}

/// Makes room where there was not enough. True where it made some: then the sweep must be run again.
template <class Queue>
bool ResidentFronts<Queue>::grow() {
  const std::size_t needed = counters().needed;
  // All that do not hold have to be known.
  const std::size_t most = std::max(kMostPairs, checked_.size() * CertificateBlocks::kBlock);
  if (needed <= pairs_.size() || pairs_.size() >= most) return false;
  const std::size_t room = std::min(needed + needed / 2, most);
  make_pair_room(room);
  return true;
}

template <class Queue>
void ResidentFronts<Queue>::collect() {
  const std::size_t count = stored();
  if (count > kReportedAnswers) {
    const std::size_t more = count - kReportedAnswers;
    queue_.copy_down(answers_.on_host().data() + kReportedAnswers, answers_.on_device().data() + kReportedAnswers,
                     more * sizeof(PairAnswer));
    queue_.wait();
  }
  const Span<const PairAnswer> answers(answers_.on_host().data(), count);
  found_.assign(part_count_, {});
  for (std::size_t p = 0; p < part_count_; ++p) {
    found_[p].least_gap = resident_front::gap_of_word(least_.on_host()[p]);
    found_[p].answers = answers;
  }
  for (std::uint32_t k = 0; k < count; ++k)
    if (answers[k].place != PairAnswer::kNone) found_[answers[k].part].roots.push_back(k);
  for (PartAnswers& part : found_)
    std::sort(part.roots.begin(), part.roots.end(),
              [&](std::uint32_t x, std::uint32_t y) { return answers[x].place < answers[y].place; });
}

}  // namespace dismantle
