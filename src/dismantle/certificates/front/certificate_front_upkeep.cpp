// SPDX-License-Identifier: Apache-2.0
// Upkeep of a front between sweeps: merges siblings and pairs separated radially, keeps parts within size limits.
#include "dismantle/certificates/front/certificate_front.h"
#include "dismantle/certificates/front/sibling_table.h"
#include "dismantle/core/contract.h"

#include <algorithm>
#include <optional>

namespace dismantle {

namespace {

/// Each part merges siblings once in this many sweeps.
constexpr std::size_t kMergePeriod = 8;
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
  return (sweeps_ + part) % kMergePeriod == kMergePeriod - 1;
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
  CertificatePart& part = parts_[index];
  std::size_t gone = merge(part, sweep, siblings, separations);
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
  };
  std::vector<Pair> tried{{ObbSubtree::whole(*a_), ObbSubtree::whole(*b_)}}, found;
  FrontSweep unused;
  for (std::size_t k = 0; k < tried.size() && k < kRadialTries; ++k) {
    const Pair pair = tried[k];
    if (const auto certificate = separate_radially(pair.a.node, pair.b.node, sweep, unused)) {
      found.push_back({pair.a, pair.b, *certificate});
    } else if (!a_->nodes[pair.a.node].leaf() || !b_->nodes[pair.b.node].leaf()) {
      const bool splits_of_a = trees().splits_a(pair.a.node, pair.b.node);
      for (std::uint32_t h = 0; h < 2; ++h)
        tried.push_back(splits_of_a ? Pair{pair.a.half(*a_, h), pair.b} : Pair{pair.a, pair.b.half(*b_, h)});
    }
  }
  if (found.empty()) return;
  const auto lies_below = [](const FrontPair& pair) {
    return [pair](const Pair& large) { return large.a.holds(pair.a) && large.b.holds(pair.b); };
  };
  for (CertificatePart& part : parts_)
    for (std::size_t i = part.size(); i-- > 0;)
      if (std::any_of(found.begin(), found.end(), lies_below(part.pair(i)))) part.remove(i);
  for (const Pair& pair : found) parts_[0].append({pair.a.node, pair.b.node}, pair.certificate);
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
