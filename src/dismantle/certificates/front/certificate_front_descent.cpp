// SPDX-License-Identifier: Apache-2.0
// The descent of a sweep: finds certificates for the pairs of a front whose own no longer hold.
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/front/front_work.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace dismantle {

namespace {

/// Pairs are examined in batches of this size.
constexpr std::size_t kBatch = 64;
/// A pair that was separated radially, and no longer is, is split into at most this many pairs in each part.
constexpr std::size_t kRadialStarts = 128;

/// True if the sweep may stop after a sample of the blocked pairs.
bool may_stop_early(const LinearSweep& sweep) {
  return sweep.max_blocked < LinearSweep().max_blocked;
}

}  // namespace

void CertificateFront::resolve(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                               const TrianglePairTest& test, FrontSweep& result) const {
  work.waiting = find_starts(work, sweep, result);
  work.blocked.assign(work.waiting.size(), 0);
  for (std::uint32_t k = 0; k < work.waiting.size(); ++k) work.items[work.waiting[k]].start = k;
  while (!work.waiting.empty()) {
    if (result.triangle_tests > sweep.max_tests) {
      result.complete = false;
      return;
    }
    const std::size_t kept = work.waiting.size() - std::min(kBatch, work.waiting.size());
    work.batch.assign(work.waiting.begin() + static_cast<std::ptrdiff_t>(kept), work.waiting.end());
    work.waiting.resize(kept);
    if (may_stop_early(sweep)) {
      const auto enough = [&](std::uint32_t i) {
        return result.blocked >= sweep.max_blocked || work.blocked[work.items[i].start] >= kMaxBlockedOfPair;
      };
      result.complete &= std::erase_if(work.batch, enough) == 0;
    }
    result.node_pairs += work.batch.size();
    resolve_batch(work, sweep, kernels, test, result);
    // Checked after the first batch, so that every sweep makes progress.
    if (result.node_pairs >= sweep.max_node_pairs && !work.waiting.empty()) {
      result.complete = false;
      result.cut = true;
      return;
    }
  }
}

std::vector<std::uint32_t> CertificateFront::find_starts(Work& work, const PreparedSweep& sweep,
                                                         FrontSweep& result) const {
  std::vector<std::uint32_t> plain, opened;
  const auto front_count = static_cast<std::uint32_t>(work.front_count);
  for (std::uint32_t i = 0; i < front_count; ++i) (work.items[i].radial ? opened : plain).push_back(i);
  // A sample should be spread over the part, where neighbours are near each other: long strides.
  const std::size_t count = plain.size();
  std::size_t stride = may_stop_early(sweep) ? count * 5 / 8 | 1 : 1;
  while (std::gcd(stride, count) > 1) stride += 2;
  std::vector<std::uint32_t> starts;
  for (std::size_t k = 0; k < count; ++k) starts.push_back(plain[(count - 1 - k) * stride % count]);
  std::vector<std::pair<double, std::uint32_t>> nearest;  // their gaps and items
  for (std::size_t k = 0; k < opened.size(); ++k) {
    prefetch_radial(work, opened, k, sweep);
    ++result.node_pairs;
    const std::uint32_t i = opened[k];
    const std::uint32_t a = work.items[i].a, b = work.items[i].b;
    if (const auto certificate = separate_radially(a, b, sweep, result)) {
      work.prove(i, *certificate);
    } else if (std::optional<CylinderFit> blocked_fit = fit(a, b, sweep)) {
      result.fits.push_back(*blocked_fit);
      result.complete = false;
    } else if (nearest.size() + opened.size() - k >= kRadialStarts || (a_->nodes[a].leaf() && b_->nodes[b].leaf())) {
      nearest.emplace_back(radial_gap(a, b, sweep), i);
    } else {
      split(work, i, opened);
    }
  }
  // The last one comes first.
  std::sort(nearest.begin(), nearest.end(), std::greater<>());
  for (const auto& [gap, i] : nearest) starts.push_back(i);
  return starts;
}

void CertificateFront::separate_boxes(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const {
  work.box_queries.clear();
  work.box_items.clear();
  for (const std::uint32_t i : work.batch) {
    const Item& item = work.items[i];
    if (item.are_triangles) continue;
    work.box_items.push_back(i);
    if (work.known_kind(item) != PairResult::None) continue;
    work.box_queries.push_back(trees().box_query(item.a, item.b));
    // Nodes are scattered in memory: the kernel would stall on each.
    __builtin_prefetch(work.box_queries.back().a);
    __builtin_prefetch(work.box_queries.back().b);
  }
  work.computed.resize(work.box_queries.size());
  if (!work.box_queries.empty())
    kernels.separate_boxes(work.box_queries.data(), work.box_queries.size(), sweep, work.computed.data());
  work.merge_known(work.box_items, PairResult::Boxes);
}

void CertificateFront::separate_triangles(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const {
  work.triangle_queries.clear();
  for (const std::uint32_t i : work.triangle_items) {
    const Item& item = work.items[i];
    if (work.known_kind(item) != PairResult::None) continue;
    work.triangle_queries.push_back(trees().triangle_query(item.a, item.b));
    __builtin_prefetch(work.triangle_queries.back().a);
    __builtin_prefetch(work.triangle_queries.back().b);
  }
  work.computed.resize(work.triangle_queries.size());
  if (!work.triangle_queries.empty())
    kernels.separate_triangles(work.triangle_queries.data(), work.triangle_queries.size(), sweep, work.computed.data());
  work.merge_known(work.triangle_items, PairResult::Triangles);
}

bool CertificateFront::accept(Work& work, std::uint32_t i, const NodeSeparation& separation, const LinearSweep& sweep,
                              FrontSweep& result) {
  if (separation.gap < sweep.limit) return false;
  result.min_gap = std::min(result.min_gap, separation.gap);
  work.prove(i, separation.certificate);
  return true;
}

std::optional<Certificate> CertificateFront::separate_radially(std::uint32_t a, std::uint32_t b,
                                                               const PreparedSweep& sweep, FrontSweep& result) const {
  for (const ThreadSweep& thread : sweep.threads) {
    const ThreadSweep::Gap gap = b_moves_ ? thread.gap(b, a) : thread.gap(a, b);
    if (gap.during < sweep.error) continue;  // a bound of the true paths, which needs no margin for arcs
    result.min_gap = std::min(result.min_gap, -rounded_up(-gap.during));
    return Certificate::thread(static_cast<std::uint32_t>(&thread.match() - threads_.data()),
                               -rounded_up(-gap.in_place), static_cast<float>(thread.phase()));
  }
  if (!sweep.radial) return std::nullopt;
  for (const RadialSweep& radial : sweep.radial->get()) {
    const double gap = b_moves_ ? radial.gap(b, a, sweep.limit) : radial.gap(a, b, sweep.limit);
    if (gap < sweep.limit) continue;
    result.min_gap = std::min(result.min_gap, -rounded_up(-gap));
    return Certificate::radial();
  }
  return std::nullopt;
}

void CertificateFront::prefetch_radial(const Work& work, const std::vector<std::uint32_t>& list, std::size_t k,
                                       const PreparedSweep& sweep) const {
  constexpr std::size_t kNear = 6, kFar = 12;
  for (const ThreadSweep& thread : sweep.threads) {
    if (k + kFar < list.size()) {
      const Item& item = work.items[list[k + kFar]];
      b_moves_ ? thread.prefetch_slots(item.b, item.a) : thread.prefetch_slots(item.a, item.b);
    }
    if (k + kNear < list.size()) {
      const Item& item = work.items[list[k + kNear]];
      b_moves_ ? thread.prefetch(item.b, item.a) : thread.prefetch(item.a, item.b);
    }
  }
}

double CertificateFront::radial_gap(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const {
  double largest = -std::numeric_limits<double>::infinity();
  if (!sweep.radial) return largest;
  for (const RadialSweep& radial : sweep.radial->get())
    largest = std::max(largest, b_moves_ ? radial.gap(b, a, largest) : radial.gap(a, b, largest));
  return largest;
}

std::optional<CylinderFit> CertificateFront::fit(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const {
  if (sweep.max_fit_deviation < 0 || !sweep.radial) return std::nullopt;
  for (const RadialSweep& radial : sweep.radial->get())
    if (std::optional<CylinderFit> found =
            b_moves_ ? radial.fit(b, a, sweep.max_fit_deviation) : radial.fit(a, b, sweep.max_fit_deviation))
      return found;
  return std::nullopt;
}

void CertificateFront::resolve_batch(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                                     const TrianglePairTest& test, FrontSweep& result) const {
  std::size_t left = 0;
  for (std::size_t k = 0; k < work.batch.size(); ++k) {
    prefetch_radial(work, work.batch, k, sweep);
    const std::uint32_t i = work.batch[k];
    if (const auto certificate = separate_radially(work.items[i].a, work.items[i].b, sweep, result)) {
      work.prove(i, *certificate);
    } else {
      work.batch[left++] = i;
    }
  }
  work.batch.resize(left);
  separate_boxes(work, sweep, kernels);
  work.triangle_items.clear();
  for (const std::uint32_t i : work.batch)
    if (work.items[i].are_triangles) work.triangle_items.push_back(i);
  for (std::size_t k = 0; k < work.box_items.size(); ++k) {
    const std::uint32_t i = work.box_items[k];
    if (accept(work, i, work.separations[k], sweep, result)) continue;
    if (trees().both_leaves(work.items[i].a, work.items[i].b)) {
      work.triangle_items.push_back(i);
    } else {
      split(work, i, work.waiting);
    }
  }

  separate_triangles(work, sweep, kernels);
  for (std::size_t k = 0; k < work.triangle_items.size(); ++k) {
    const std::uint32_t i = work.triangle_items[k];
    if (accept(work, i, work.separations[k], sweep, result)) continue;
    test_triangles(work, i, work.separations[k].certificate.axis, test, result);
  }
}

void CertificateFront::test_triangles(Work& work, std::uint32_t i, Vec3f hint, const TrianglePairTest& test,
                                      FrontSweep& result) const {
  const Item item = work.items[i];
  ++result.triangle_tests;
  const BoxPairQuery query = trees().box_query(item.a, item.b);
  const TrianglePairVerdict verdict = test({query.a->child, query.b->child, hint, work.known_test(item)});
  work.prove(i, verdict.certificate);
  if (!verdict.free || verdict.cut_short) {
    ++result.blocked;
    ++work.blocked[item.start];
  }
  result.min_gap = std::min(result.min_gap, verdict.gap);
}

void CertificateFront::split(Work& work, std::uint32_t i, std::vector<std::uint32_t>& halves) const {
  const Item parent = work.items[i];
  if (work.keeps) {
    work.items[i].first_child = static_cast<std::uint32_t>(work.items.size());
  } else {
    work.done.push_back(i);
  }
  const bool splits_of_a = trees().splits_a(parent.a, parent.b);
  const std::uint32_t known =
      work.known_kind(parent) == PairResult::Split ? work.known_pairs[parent.known].first_child : PairResult::kNone;
  for (std::uint32_t k = 0; k < 2; ++k) {
    Item child = parent;
    child.known = known == PairResult::kNone ? Item::kNone : known + k;
    // The first takes its parent's slot, the other is appended.
    if (k > 0) child.slot = Item::kNone;
    if (splits_of_a) {
      child.a = a_->nodes[parent.a].child + k;
    } else {
      child.b = b_->nodes[parent.b].child + k;
    }
    halves.push_back(work.add(child));
  }
}

}  // namespace dismantle
