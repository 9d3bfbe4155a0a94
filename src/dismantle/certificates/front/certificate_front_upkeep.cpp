// SPDX-License-Identifier: Apache-2.0
// Upkeep of a front between sweeps: merges siblings and pairs separated radially, keeps parts within size limits.
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/front/sibling_table.h"
#include "dismantle/core/contract.h"

#include <algorithm>
#include <optional>

namespace dismantle {

namespace {

/// If fewer than one in this many pairs of a part merge, its merge period doubles, up to the longest one.
constexpr std::size_t kRareMerges = 32, kLongestMergePeriod = 64;
/// Merging is repeated while it removes more than one in this many pairs.
constexpr std::size_t kMergeShare = 8;
/// Parts with more pairs than this are split in two.
constexpr std::size_t kLargestPart = 2048;
/// Sweeps that were not free leave a front finely divided: after this many of them, a front of at least this many pairs
/// is searched for pairs of large nodes that are separated radially; at most this many pairs of nodes are tried.
constexpr std::size_t kBlockedToMerge = 3;
constexpr std::size_t kMinToMergeRadial = 64;
constexpr std::size_t kRadialTries = 256;

}  // namespace

bool CertificateFront::merge_due(std::size_t part) const {
  const std::size_t period = parts_[part].merge_period();
  return (sweeps_ + part) % period == period - 1;
}

std::vector<Siblings> CertificateFront::siblings_of(std::size_t part) const {
  return merge_due(part) ? find_siblings(parts_[part]) : std::vector<Siblings>{};
}

void CertificateFront::merge_part(std::size_t index, const PreparedSweep& sweep, const FrontKernels& kernels) {
  const std::vector<Siblings> siblings = siblings_of(index);
  merge_part(index, sweep, kernels, siblings, separate_parents(siblings, sweep, kernels));
}

void CertificateFront::merge_part(std::size_t index, const PreparedSweep& sweep, const FrontKernels& kernels,
                                  Span<const Siblings> siblings, Span<const NodeSeparation> separations) {
  DISMANTLE_EXPECT(siblings.size() == separations.size());
  if (!merge_due(index)) return;
  CertificatePart& part = parts_[index];
  std::size_t gone = merge(part, sweep, siblings, separations);
  const bool rare = gone * kRareMerges < part.size();
  part.set_merge_period(rare ? std::min(2 * part.merge_period(), kLongestMergePeriod) : kMergePeriod);
  while (gone * kMergeShare > part.size()) {
    const std::vector<Siblings> more = find_siblings(part);
    gone = merge(part, sweep, more, separate_parents(more, sweep, kernels));
  }
}

std::vector<Siblings> CertificateFront::find_siblings(const CertificatePart& part) const {
  std::vector<Siblings> found;
  SiblingTable table(2 * part.size());
  const auto siblings = [&](FrontPair x, FrontPair y, bool halves_a) {
    return halves_a ? x.b == y.b && a_->nodes[x.a].parent == a_->nodes[y.a].parent
                    : x.a == y.a && b_->nodes[x.b].parent == b_->nodes[y.b].parent;
  };
  const auto find_half = [&](FrontPair parent, bool halves_a, std::uint32_t i) {
    const std::optional<std::uint32_t> other = table.match(parent.a, parent.b, halves_a, i);
    if (!other || !siblings(part.pair(*other), part.pair(i), halves_a)) return;
    found.push_back({parent, *other, i});
  };
  for (std::uint32_t i = 0; i < part.size(); ++i) {
    const FrontPair pair = part.pair(i);
    const std::uint32_t up_a = a_->nodes[pair.a].parent, up_b = b_->nodes[pair.b].parent;
    if (up_a != ObbNode::kNone) find_half({up_a, pair.b}, true, i);
    if (up_b != ObbNode::kNone) find_half({pair.a, up_b}, false, i);
  }
  return found;
}

std::vector<NodeSeparation> CertificateFront::separate_parents(Span<const Siblings> siblings,
                                                               const PreparedSweep& sweep,
                                                               const FrontKernels& kernels) const {
  std::vector<BoxPairQuery> queries;
  queries.reserve(siblings.size());
  for (const Siblings& s : siblings) queries.push_back(trees().box_query(s.parent.a, s.parent.b));
  std::vector<NodeSeparation> separations(queries.size());
  if (!queries.empty()) kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());
  return separations;
}

std::size_t CertificateFront::merge(CertificatePart& part, const PreparedSweep& sweep, Span<const Siblings> siblings,
                                    Span<const NodeSeparation> separations) const {
  if (siblings.empty()) return 0;
  FrontSweep unused;
  std::vector<bool> merged(part.size());
  std::vector<std::uint32_t> gone;
  for (std::size_t k = 0; k < siblings.size(); ++k) {
    const Siblings& s = siblings[k];
    if (merged[s.first] || merged[s.second]) continue;
    const std::optional<Certificate> certificate = separations[k].gap >= sweep.limit
                                                       ? separations[k].certificate
                                                       : separate_radially(s.parent.a, s.parent.b, sweep, unused);
    if (!certificate) continue;
    part.set(s.first, s.parent, *certificate);
    merged[s.first] = merged[s.second] = true;
    gone.push_back(s.second);
  }
  std::sort(gone.begin(), gone.end());
  for (auto i = gone.rbegin(); i != gone.rend(); ++i) part.remove(*i);
  return gone.size();
}

CertificatePart CertificateFront::split_part(CertificatePart& part) const {
  std::vector<std::uint32_t> of_a(part.size()), of_b(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    of_a[i] = part.pair(i).a;
    of_b[i] = part.pair(i).b;
  }
  // Siblings are nodes 2k - 1 and 2k: a border at an odd number does not separate them.
  const auto middle_of = [](std::vector<std::uint32_t>& nodes) {
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    std::nth_element(nodes.begin(), middle, nodes.end());
    return *middle | 1u;
  };
  const auto range = [](const std::vector<std::uint32_t>& nodes) {
    const auto [first, last] = std::minmax_element(nodes.begin(), nodes.end());
    return *last - *first;
  };
  const bool by_a = range(of_a) >= range(of_b);
  std::vector<std::uint32_t>& nodes = by_a ? of_a : of_b;
  std::uint32_t border = middle_of(nodes);
  // If most pairs have the first node, it and its sibling go before the border, so that neither part is empty.
  if (*std::min_element(nodes.begin(), nodes.end()) >= border) border += 2;
  CertificatePart kept, rest;
  for (std::size_t i = 0; i < part.size(); ++i)
    ((by_a ? part.pair(i).a : part.pair(i).b) < border ? kept : rest).append(part.pair(i), part.certificate(i));
  part = std::move(kept);
  return rest;
}

void CertificateFront::merge_radial(const PreparedSweep& sweep) {
  struct Pair {
    ObbSubtree a, b;
    Certificate certificate = Certificate::none();
    bool is_separated = false;
    std::size_t first_half = 0;  // in the list of pairs tried; 0 if it has no halves there
  };
  std::vector<Pair> tried{{ObbSubtree::whole(*a_), ObbSubtree::whole(*b_)}};
  FrontSweep unused;
  bool any = false;
  for (std::size_t k = 0; k < tried.size() && k < kRadialTries; ++k) {
    const ObbSubtree a = tried[k].a, b = tried[k].b;
    if (const auto certificate = separate_radially(a.node, b.node, sweep, unused)) {
      tried[k].certificate = *certificate;
      tried[k].is_separated = any = true;
    } else if (!a_->nodes[a.node].leaf() || !b_->nodes[b.node].leaf()) {
      tried[k].first_half = tried.size();
      const bool splits_of_a = trees().splits_a(a.node, b.node);
      for (std::uint32_t h = 0; h < 2; ++h)
        tried.push_back(splits_of_a ? Pair{a.half(*a_, h), b} : Pair{a, b.half(*b_, h)});
    }
  }
  if (!any) return;
  const auto holds = [](const Pair& large, const FrontPair& pair) {
    return large.a.holds(pair.a) && large.b.holds(pair.b);
  };
  const auto lies_below_separated = [&](const FrontPair& pair) {
    const Pair* large = tried.data();
    while (!large->is_separated) {
      if (large->first_half == 0) return false;
      const Pair* const half = &tried[large->first_half];
      if (holds(half[0], pair)) {
        large = half;
      } else if (holds(half[1], pair)) {
        large = half + 1;
      } else {
        return false;
      }
    }
    return true;
  };
  for (CertificatePart& part : parts_)
    for (std::size_t i = part.size(); i-- > 0;)
      if (lies_below_separated(part.pair(i))) part.remove(i);
  for (const Pair& pair : tried)
    if (pair.is_separated) parts_[0].append({pair.a.node, pair.b.node}, pair.certificate);
}

void CertificateFront::end_sweep(const PreparedSweep& sweep, bool free) {
  ++sweeps_;
  blocked_ += !free;
  if (free && blocked_ >= kBlockedToMerge && size() > kMinToMergeRadial) {
    merge_radial(sweep);
    blocked_ = 0;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].size() <= kLargestPart) continue;
    CertificatePart rest = split_part(parts_[p]);
    if (rest.size() > 0) parts_.push_back(std::move(rest));
  }
  // Join parts that merging has left small, so that siblings can meet again.
  for (std::size_t p = 1; p < parts_.size();) {
    CertificatePart& before = parts_[p - 1];
    const CertificatePart& part = parts_[p];
    if (before.size() + part.size() > kLargestPart / 2) {
      ++p;
      continue;
    }
    for (std::size_t i = 0; i < part.size(); ++i) before.append(part.pair(i), part.certificate(i));
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(p));
    for (std::size_t behind = p; behind < parts_.size(); ++behind) parts_[behind].mark_changed();
  }
}

void CertificateFront::exchange_roles() {
  b_moves_ = !b_moves_;
  forget();
}

void CertificateFront::forget() {
  for (CertificatePart& part : parts_)
    for (std::size_t i = 0; i < part.size(); ++i) {
      Certificate c = part.certificate(i);
      c.offset = kNoCertificate;
      if (c.hull.kind == NodeHull::kNone) c = Certificate::radial();
      part.set_certificate(i, c);
    }
}

}  // namespace dismantle
