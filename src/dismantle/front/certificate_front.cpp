// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/certificate_front.h"

#include "dismantle/core/contract.h"
#include "dismantle/front/sibling_table.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

namespace dismantle {

namespace {

/// Parts of more pairs than this are cut in two.
constexpr std::size_t kLargestPart = 2048;
/// Every part looks for siblings to merge each so many sweeps.
constexpr std::size_t kMergePeriod = 8;
/// It goes on with that while more than one in so many pairs goes.
constexpr std::size_t kMergeShare = 8;
/// So many pairs are looked at together.
constexpr std::size_t kBatch = 64;
/// Where some blocked pairs are enough: so many that come from one pair of the front.
constexpr std::size_t kEnoughOfPair = 2;
/// What was parted as round, and is not any more, is opened to so many pairs of each part of the front.
constexpr std::size_t kRoundStarts = 128;
/// After so many sweeps that were not free, as they leave it fine, a front of more pairs than this is looked through
/// for what is parted as round, in so many pairs of nodes.
constexpr std::size_t kBlockedToMerge = 3;
constexpr std::size_t kLeastToMergeRound = 64;
constexpr std::size_t kRoundTries = 256;
/// The offset of a certificate of which only the side is left.
constexpr float kForgotten = -1e29f;
/// Once a component has turned by more than this [of a unit vector], certificates are judged anew: they may use the
/// allowance only as long as they face along the normals.
constexpr double kMostTurn = 0.25;

/// The rounding of a gap in float32, in units of u = 2^-24 times the sum of the coordinates' sizes (docs/design/
/// 0006-certificates.md derives 40; the rest is margin).
constexpr double kGapRoundings = 48;

RigidTransformF to_float(const RigidTransform& t) {
  RigidTransformF f;
  for (int i = 0; i < 3; ++i) f.row[i] = to_float(t.rotation.row[i]);
  f.translation = to_float(t.translation);
  return f;
}

/// How far a unit vector turned by one rotation is at most from the same turned by the other: the difference's spectral
/// norm, which for rotations is its Frobenius norm over sqrt(2).
double turn_between(const Mat3& a, const Mat3& b) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += length_squared(a.row[i] - b.row[i]);
  return std::sqrt(square / 2);
}

/// The gap of a certificate with A where `t` has it, up to LinearSweep::error.
float gap_at(const Certificate& c, const RigidTransformF& t) {
  const Vec3f w = c.axis.x * t.row[0] + c.axis.y * t.row[1] + c.axis.z * t.row[2];
  const NodeHull& h = c.hull;
  const float s0 = dot(w, h.span[0]), s1 = dot(w, h.span[1]), s2 = dot(w, h.span[2]);
  const float reach = h.kind > NodeHull::kBox ? std::max({0.0f, s0, s1}) : std::abs(s0) + std::abs(s1) + std::abs(s2);
  return c.offset - dot(c.axis, t.translation) - dot(w, h.center) - reach;
}

Certificate nothing() {
  Certificate certificate;
  certificate.offset = kNoCertificate;
  return certificate;
}

Certificate parted_as_round() {
  Certificate certificate = nothing();
  certificate.hull.kind = NodeHull::kNone;
  return certificate;
}

/// Whether some of what is blocked are enough.
bool some(const LinearSweep& sweep) {
  return sweep.enough_blocked < LinearSweep().enough_blocked;
}

float reach(const ObbTree& tree) {
  const ObbNode& root = tree.nodes[0];
  return root.radius + length(root.box.center);
}

}  // namespace

/// What a part's sweep works on.
struct CertificateFront::Work {
  std::vector<std::uint32_t> failing;  // indices into the part
  std::vector<Item> items;             // the failing ones, in order, then their descendants
  std::vector<Certificate> proofs;
  std::size_t of_front = 0;            // the first so many items are
  std::vector<std::uint32_t> blocked;  // of each start
  std::vector<std::uint32_t> waiting;  // indices of items, the next one last
  std::vector<std::uint32_t> batch;
  std::vector<BoxPairQuery> queries;  // of a batch
  std::vector<std::uint32_t> asked;   // their items
  std::vector<TrianglePairQuery> triangle_queries;
  std::vector<std::uint32_t> triangles_asked;
  std::vector<NodeSeparation> separations;

  void prove(Item& item, const Certificate& certificate) {
    item.proof = static_cast<std::uint32_t>(proofs.size());
    proofs.push_back(certificate);
  }
};

CertificateFront::CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides, const RoundShape* round_a,
                                   const RoundShape* round_b, Span<const ThreadMatch> threads)
    : a_(&a), b_(&b), round_a_(round_a), round_b_(round_b), threads_(threads), parts_(1), sides_(sides) {
  DISMANTLE_EXPECT(!a.empty() && !b.empty());
  parts_[0].append({0, 0}, nothing());
}

std::size_t CertificateFront::size() const {
  std::size_t sum = 0;
  for (const CertificatePart& part : parts_) sum += part.size();
  return sum;
}

bool CertificateFront::judges(const Mat3& rotation) const {
  return sides_ != SideRule::Normals || turn_between(judged_, rotation) <= kMostTurn;
}

PreparedSweep CertificateFront::begin_sweep(const PairMotion& motion) {
  if (!judges(motion.middle)) {
    forget();
    judged_ = motion.middle;
  }
  return begin_look(motion);
}

PreparedSweep CertificateFront::begin_look(const PairMotion& motion) const {
  PreparedSweep sweep;
  sweep.t0 = to_float(motion.t0);
  sweep.t1 = to_float(motion.t1);
  for (int i = 0; i < 3; ++i) sweep.middle[i] = to_float(motion.middle.row[i]);
  sweep.enough_blocked = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(motion.enough_blocked / parts_.size(), kEnoughOfPair, sweep.enough_blocked));
  sweep.judged = judges(motion.middle);
  const double size = std::max(length(motion.t0.translation), length(motion.t1.translation)) + reach(*a_) + reach(*b_);
  const double error = kGapRoundings * 0x1p-24 * size;
  sweep.error = static_cast<float>(error);
  sweep.allowed = static_cast<float>(motion.allowed);
  sweep.limit = static_cast<float>(-motion.allowed + motion.deviation + error);
  sweep.meeting = static_cast<float>(motion.deviation + error);
  sweep.apart = static_cast<float>(motion.allowed + motion.deviation + error);
  // Sides are remembered by axes only.
  if (round_a_ && round_b_ && sides_ != SideRule::Memory)
    sweep.rounds = b_moves_ ? std::make_unique<RoundSweeps>(*round_b_, b_->origin, *round_a_, a_->origin, motion)
                            : std::make_unique<RoundSweeps>(*round_a_, a_->origin, *round_b_, b_->origin, motion);
  if (sides_ == SideRule::Memory) return sweep;
  for (const ThreadMatch& match : threads_) {
    const ThreadSweep thread(match, b_moves_ ? 1 : 0, motion);
    if (thread.useful()) sweep.threads.push_back(thread);
  }
  return sweep;
}

FrontSweep CertificateFront::sweep_part(std::size_t index, const PreparedSweep& sweep, const FrontKernels& kernels,
                                        const LeafTest& test) {
  CertificatePart& part = parts_[index];
  FrontSweep result;
  if ((sweeps_ + index) % kMergePeriod == kMergePeriod - 1)
    while (merge(part, sweep, kernels) * kMergeShare > part.size()) {
    }

  Work work;
  find_failing(part, sweep, kernels, work, result);
  if (work.items.empty()) return result;

  resolve(work, sweep, kernels, test, result);
  replace(part, work, result.blocked == 0 && result.complete);
  return result;
}

void CertificateFront::find_failing(const CertificatePart& part, const PreparedSweep& sweep,
                                    const FrontKernels& kernels, Work& work, FrontSweep& result) const {
  work.failing.resize(part.size());
  CertificateCheck check;
  if (sweep.judged) {
    check = kernels.check_certificates(part.blocks(), part.size(), sweep, work.failing.data());
  } else {
    std::iota(work.failing.begin(), work.failing.end(), 0u);
    check.failing = part.size();
  }
  result.least_gap = std::min(result.least_gap, check.least_gap);
  result.touching |= sides_ != SideRule::Normals && check.least_gap < sweep.meeting;
  for (std::size_t k = 0; k < check.failing; ++k) {
    const std::uint32_t i = work.failing[k];
    Item item;
    item.a = part.pair(i).a;
    item.b = part.pair(i).b;
    item.place = i;
    item.origin = static_cast<std::uint32_t>(k);
    item.hint = hint_of(part, i, sweep);
    item.round = part.kind(i) == NodeHull::kNone;
    item.of_triangles = part.kind(i) > NodeHull::kBox;
    item.on_edge = part.kind(i) == NodeHull::kTriangleOnEdge;
    work.items.push_back(item);
  }
  work.of_front = work.items.size();
}

FrontSweep CertificateFront::look(const PreparedSweep& sweep, const FrontKernels& kernels, const LeafTest& test) const {
  FrontSweep result;
  for (const CertificatePart& part : parts_) {
    Work work;
    find_failing(part, sweep, kernels, work, result);
    if (!work.items.empty()) resolve(work, sweep, kernels, test, result);
  }
  return result;
}

Vec3f CertificateFront::hint_of(const CertificatePart& part, std::size_t i, const LinearSweep& sweep) const {
  if (sides_ != SideRule::Memory || !(part.offset(i) > kNoCertificate)) return {};
  return gap_at(part.certificate(i), sweep.t0) < sweep.error ? part.axis(i) : Vec3f{};
}

float CertificateFront::limit(Vec3f guard, const LinearSweep& sweep) const {
  return sides_ == SideRule::Memory && length_squared(guard) == 0 ? sweep.meeting : sweep.limit;
}

void CertificateFront::resolve(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                               const LeafTest& test, FrontSweep& result) const {
  work.waiting = find_starts(work, sweep, result);
  work.blocked.assign(work.waiting.size(), 0);
  for (std::uint32_t k = 0; k < work.waiting.size(); ++k) work.items[work.waiting[k]].start = k;
  while (!work.waiting.empty()) {
    const std::size_t kept = work.waiting.size() - std::min(kBatch, work.waiting.size());
    work.batch.assign(work.waiting.begin() + static_cast<std::ptrdiff_t>(kept), work.waiting.end());
    work.waiting.resize(kept);
    if (some(sweep)) {
      const auto enough = [&](std::uint32_t i) {
        return result.blocked >= sweep.enough_blocked || work.blocked[work.items[i].start] >= kEnoughOfPair;
      };
      result.complete &= std::erase_if(work.batch, enough) == 0;
    }
    resolve_batch(work, sweep, kernels, test, result);
  }
}

std::vector<std::uint32_t> CertificateFront::find_starts(Work& work, const PreparedSweep& sweep,
                                                         FrontSweep& result) const {
  std::vector<std::uint32_t> plain, opened;
  const auto of_front = static_cast<std::uint32_t>(work.of_front);
  for (std::uint32_t i = 0; i < of_front; ++i) (work.items[i].round ? opened : plain).push_back(i);
  // Where some are enough they should lie far from each other, as the front's pairs do not: in long strides.
  const std::size_t count = plain.size();
  std::size_t stride = some(sweep) ? count * 5 / 8 | 1 : 1;
  while (std::gcd(stride, count) > 1) stride += 2;
  std::vector<std::uint32_t> starts;
  for (std::size_t k = 0; k < count; ++k) starts.push_back(plain[(count - 1 - k) * stride % count]);
  std::vector<std::pair<double, std::uint32_t>> nearest;  // their gaps and items
  for (std::size_t k = 0; k < opened.size(); ++k) {
    const std::uint32_t i = opened[k];
    const std::uint32_t a = work.items[i].a, b = work.items[i].b;
    if (parts_round(a, b, sweep, result)) {
      work.prove(work.items[i], parted_as_round());
    } else if (nearest.size() + opened.size() - k >= kRoundStarts || (a_->nodes[a].leaf() && b_->nodes[b].leaf())) {
      nearest.emplace_back(round_gap(a, b, sweep), i);
    } else {
      const std::uint32_t first = split(work, i);
      opened.insert(opened.end(), {first, first + 1});
    }
  }
  // The last one comes first.
  std::sort(nearest.begin(), nearest.end(), std::greater<>());
  for (const auto& [gap, i] : nearest) starts.push_back(i);
  return starts;
}

void CertificateFront::separate_boxes(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const {
  work.queries.clear();
  work.asked.clear();
  for (const std::uint32_t i : work.batch) {
    const Item& item = work.items[i];
    if (item.of_triangles) continue;
    work.queries.push_back(query(item.a, item.b, item.hint));
    // Nodes lie far apart: the kernel would wait for each.
    __builtin_prefetch(work.queries.back().a);
    __builtin_prefetch(work.queries.back().b);
    work.asked.push_back(i);
  }
  work.separations.resize(work.queries.size());
  if (!work.queries.empty())
    kernels.separate_boxes(work.queries.data(), work.queries.size(), sweep, work.separations.data());
}

void CertificateFront::separate_triangles(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const {
  work.triangle_queries.clear();
  for (const std::uint32_t i : work.triangles_asked) {
    const Item& item = work.items[i];
    work.triangle_queries.push_back(triangle_query(item.a, item.b, item.hint));
    __builtin_prefetch(work.triangle_queries.back().a);
    __builtin_prefetch(work.triangle_queries.back().b);
  }
  work.separations.resize(work.triangle_queries.size());
  if (!work.triangle_queries.empty())
    kernels.separate_triangles(work.triangle_queries.data(), work.triangle_queries.size(), sweep,
                               work.separations.data());
}

bool CertificateFront::take(Work& work, Item& item, const NodeSeparation& separation, const LinearSweep& sweep,
                            FrontSweep& result) const {
  if (separation.gap < limit(item.hint, sweep)) return false;
  const bool on_edge = separation.certificate.hull.kind == NodeHull::kTriangleOnEdge;
  const bool may_meet = separation.gap < sweep.meeting && (on_edge || sides_ != SideRule::Normals);
  // Moving triangles may be apart although no one axis says so: that has to be found out once.
  if (may_meet && on_edge && !item.on_edge) return false;
  result.least_gap = std::min(result.least_gap, separation.gap);
  result.touching |= may_meet;
  work.prove(item, separation.certificate);
  return true;
}

bool CertificateFront::parts_round(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep,
                                   FrontSweep& result) const {
  for (const ThreadSweep& thread : sweep.threads) {
    const double gap = b_moves_ ? thread.gap(b, a) : thread.gap(a, b);
    if (gap < sweep.error) continue;  // it is of the true paths, which need no room for arcs
    result.least_gap = std::min(result.least_gap, -rounded_up(-gap));
    return true;
  }
  if (!sweep.rounds) return false;
  for (const RoundSweep& round : sweep.rounds->get()) {
    const RoundSweep::Gap found = b_moves_ ? round.gap(b, a, sweep.limit) : round.gap(a, b, sweep.limit);
    const double limit = sides_ == SideRule::Free || found.facing ? sweep.limit : sweep.meeting;
    if (found.gap < limit) continue;
    result.least_gap = std::min(result.least_gap, -rounded_up(-found.gap));
    result.touching |= found.gap < sweep.meeting && !(sides_ == SideRule::Normals && found.face_on);
    return true;
  }
  return false;
}

double CertificateFront::round_gap(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const {
  double most = -std::numeric_limits<double>::infinity();
  if (!sweep.rounds) return most;
  for (const RoundSweep& round : sweep.rounds->get())
    most = std::max(most, (b_moves_ ? round.gap(b, a, most) : round.gap(a, b, most)).gap);
  return most;
}

void CertificateFront::resolve_batch(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                                     const LeafTest& test, FrontSweep& result) const {
  std::erase_if(work.batch, [&](std::uint32_t i) {
    Item& item = work.items[i];
    if (!parts_round(item.a, item.b, sweep, result)) return false;
    work.prove(item, parted_as_round());
    return true;
  });
  separate_boxes(work, sweep, kernels);
  work.triangles_asked.clear();
  for (const std::uint32_t i : work.batch)
    if (work.items[i].of_triangles) work.triangles_asked.push_back(i);
  for (std::size_t k = 0; k < work.asked.size(); ++k) {
    const std::uint32_t i = work.asked[k];
    if (take(work, work.items[i], work.separations[k], sweep, result)) continue;
    if (work.queries[k].a->leaf() && work.queries[k].b->leaf()) {
      work.triangles_asked.push_back(i);
    } else {
      const std::uint32_t first = split(work, i);
      work.waiting.insert(work.waiting.end(), {first, first + 1});
    }
  }

  separate_triangles(work, sweep, kernels);
  for (std::size_t k = 0; k < work.triangles_asked.size(); ++k) {
    Item& item = work.items[work.triangles_asked[k]];
    if (take(work, item, work.separations[k], sweep, result)) continue;
    if (sides_ != SideRule::Memory) item.hint = work.separations[k].certificate.axis;
    test_leaves(work, item, test, result);
  }
}

void CertificateFront::test_leaves(Work& work, Item& item, const LeafTest& test, FrontSweep& result) const {
  ++result.leaf_tests;
  const LeafVerdict verdict = test(moving_face(item.a, item.b), fixed_face(item.a, item.b), item.hint);
  work.prove(item, verdict.certificate);
  if (!verdict.free || verdict.cut_short) {
    ++result.blocked;
    ++work.blocked[item.start];
  }
  result.least_gap = std::min(result.least_gap, verdict.gap);
  result.touching |= !verdict.harmless;
}

std::uint32_t CertificateFront::split(Work& work, std::uint32_t i) const {
  const Item parent = work.items[i];
  const auto first = static_cast<std::uint32_t>(work.items.size());
  work.items[i].first_child = first;
  const bool splits_of_a = splits_a(parent.a, parent.b);
  for (std::uint32_t k = 0; k < 2; ++k) {
    Item child = parent;
    // The first takes its parent's place, others come behind all.
    if (k > 0) child.place = Item::kNone;
    if (splits_of_a) {
      child.a = a_->nodes[parent.a].child + k;
    } else {
      child.b = b_->nodes[parent.b].child + k;
    }
    work.items.push_back(child);
  }
  return first;
}

void CertificateFront::replace(CertificatePart& part, const Work& work, bool free) const {
  for (std::uint32_t i = 0; i < work.items.size(); ++i) {
    const Item& item = work.items[i];
    if (item.first_child != Item::kNone || (item.round && !free)) continue;
    Certificate certificate;
    if (item.proof != Item::kNone) {
      certificate = work.proofs[item.proof];
    } else if (i < work.of_front) {
      continue;  // stays as it was
    } else {
      certificate.axis = item.hint;
      certificate.offset = length_squared(item.hint) > 0 ? kForgotten : kNoCertificate;
    }
    if (item.place == Item::kNone) {
      part.append({item.a, item.b}, certificate);
    } else {
      part.set(item.place, {item.a, item.b}, certificate);
    }
  }
}

std::size_t CertificateFront::merge(CertificatePart& part, const PreparedSweep& sweep,
                                    const FrontKernels& kernels) const {
  struct Siblings {
    FrontPair parent;
    std::uint32_t first, second;
  };
  std::vector<Siblings> found;
  std::vector<BoxPairQuery> queries;
  SiblingTable table(2 * part.size());
  const auto siblings = [&](FrontPair x, FrontPair y, bool halves_a) {
    return halves_a ? x.b == y.b && a_->nodes[x.a].parent == a_->nodes[y.a].parent
                    : x.a == y.a && b_->nodes[x.b].parent == b_->nodes[y.b].parent;
  };
  const auto look_for = [&](FrontPair parent, bool halves_a, std::uint32_t i) {
    const std::optional<std::uint32_t> other = table.meet(parent.a, parent.b, halves_a, i);
    if (!other || !siblings(part.pair(*other), part.pair(i), halves_a)) return;
    // Siblings on different sides of the same thing stay apart; one side is handed on.
    const Vec3f one = hint_of(part, *other, sweep), two = hint_of(part, i, sweep);
    if (sides_ == SideRule::Memory && dot(one, two) < 0) return;
    queries.push_back(query(parent.a, parent.b, length_squared(one) > 0 ? one : two));
    found.push_back({parent, *other, i});
  };
  for (std::uint32_t i = 0; i < part.size(); ++i) {
    const FrontPair pair = part.pair(i);
    const std::uint32_t up_a = a_->nodes[pair.a].parent, up_b = b_->nodes[pair.b].parent;
    if (up_a != ObbNode::kNone) look_for({up_a, pair.b}, true, i);
    if (up_b != ObbNode::kNone) look_for({pair.a, up_b}, false, i);
  }
  if (queries.empty()) return 0;
  std::vector<NodeSeparation> separations(queries.size());
  kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());

  FrontSweep unused;
  std::vector<bool> merged(part.size());
  std::vector<std::uint32_t> gone;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Siblings& s = found[k];
    if (merged[s.first] || merged[s.second]) continue;
    const bool by_boxes = separations[k].gap >= limit(queries[k].guard, sweep);
    if (!by_boxes && !parts_round(s.parent.a, s.parent.b, sweep, unused)) continue;
    part.set(s.first, s.parent, by_boxes ? separations[k].certificate : parted_as_round());
    merged[s.first] = merged[s.second] = true;
    gone.push_back(s.second);
  }
  std::sort(gone.begin(), gone.end());
  for (auto i = gone.rbegin(); i != gone.rend(); ++i) part.remove(*i);
  return gone.size();
}

CertificatePart CertificateFront::cut(CertificatePart& part) const {
  std::vector<std::uint32_t> of_a(part.size()), of_b(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    of_a[i] = part.pair(i).a;
    of_b[i] = part.pair(i).b;
  }
  // Siblings are nodes 2k - 1 and 2k: a border at an odd number does not part them.
  const auto middle_of = [](std::vector<std::uint32_t>& nodes) {
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    std::nth_element(nodes.begin(), middle, nodes.end());
    return *middle | 1u;
  };
  const auto spread = [](const std::vector<std::uint32_t>& nodes) {
    const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
    return *most - *least;
  };
  const bool by_a = spread(of_a) >= spread(of_b);
  std::vector<std::uint32_t>& nodes = by_a ? of_a : of_b;
  std::uint32_t border = middle_of(nodes);
  // Where most pairs have the first node, it and its sibling go before the border: something has to.
  if (*std::min_element(nodes.begin(), nodes.end()) >= border) border += 2;
  CertificatePart kept, rest;
  for (std::size_t i = 0; i < part.size(); ++i)
    ((by_a ? part.pair(i).a : part.pair(i).b) < border ? kept : rest).append(part.pair(i), part.certificate(i));
  part = std::move(kept);
  return rest;
}

void CertificateFront::merge_round(const PreparedSweep& sweep) {
  struct Pair {
    ObbSubtree a, b;
  };
  std::vector<Pair> tried{{ObbSubtree::whole(*a_), ObbSubtree::whole(*b_)}}, found;
  FrontSweep unused;
  for (std::size_t k = 0; k < tried.size() && k < kRoundTries; ++k) {
    const Pair pair = tried[k];
    if (parts_round(pair.a.node, pair.b.node, sweep, unused)) {
      found.push_back(pair);
    } else if (!a_->nodes[pair.a.node].leaf() || !b_->nodes[pair.b.node].leaf()) {
      const bool splits_of_a = splits_a(pair.a.node, pair.b.node);
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
  for (const Pair& pair : found) parts_[0].append({pair.a.node, pair.b.node}, parted_as_round());
}

void CertificateFront::end_sweep(const PreparedSweep& sweep, bool free) {
  ++sweeps_;
  blocked_ += !free;
  if (free && blocked_ >= kBlockedToMerge && size() > kLeastToMergeRound) {
    merge_round(sweep);
    blocked_ = 0;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (parts_[p].size() <= kLargestPart) continue;
    CertificatePart rest = cut(parts_[p]);
    if (rest.size() > 0) parts_.push_back(std::move(rest));
  }
  // Parts that merging has left small join, so that siblings meet again.
  for (std::size_t p = 1; p < parts_.size();) {
    CertificatePart& before = parts_[p - 1];
    const CertificatePart& part = parts_[p];
    if (before.size() + part.size() > kLargestPart / 2) {
      ++p;
      continue;
    }
    for (std::size_t i = 0; i < part.size(); ++i) before.append(part.pair(i), part.certificate(i));
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(p));
  }
}

void CertificateFront::exchange_roles(const Mat3& rotation) {
  const Mat3 back = transposed(rotation);
  for (CertificatePart& part : parts_)
    for (std::size_t i = 0; i < part.size(); ++i) {
      Certificate c = part.certificate(i);
      const Vec3f axis = c.axis;
      c.axis = to_float(-(back * Vec3{axis.x, axis.y, axis.z}));
      part.set_certificate(i, c);
    }
  b_moves_ = !b_moves_;
  forget();
}

void CertificateFront::forget() {
  for (CertificatePart& part : parts_)
    for (std::size_t i = 0; i < part.size(); ++i) {
      Certificate c = part.certificate(i);
      c.offset = std::min(c.offset, kForgotten);
      part.set_certificate(i, c);
    }
}

}  // namespace dismantle
