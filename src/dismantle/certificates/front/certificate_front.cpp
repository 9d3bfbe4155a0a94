// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_front.h"

#include "dismantle/core/contract.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace dismantle {

namespace {

/// So many pairs are looked at together.
constexpr std::size_t kBatch = 64;
/// Where some blocked pairs are enough: so many that come from one pair of the front.
constexpr std::size_t kEnoughOfPair = 2;
/// What was parted as round, and is not any more, is opened to so many pairs of each part of the front.
constexpr std::size_t kRoundStarts = 128;
/// Once a component has turned by more than this [of a unit vector], certificates are judged anew: they may use the
/// allowance only as long as they face along the normals.
constexpr double kMaxTurn = 0.25;

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
  std::vector<NodeSeparation> separations;  // of what was asked, in order
  std::vector<NodeSeparation> computed;     // of the queries
  Span<const PairResult> answers;           // of a device, if any was asked

  void prove(Item& item, const Certificate& certificate) {
    item.proof = static_cast<std::uint32_t>(proofs.size());
    proofs.push_back(certificate);
  }
  PairResult::Kind known(const Item& item) const {
    return item.answer == Item::kNone ? PairResult::None : answers[item.answer].kind;
  }
  /// Puts together what was computed of the queries and what is known of the rest of what was asked: those whose
  /// answer is not of this kind were found not to be apart.
  void join(const std::vector<std::uint32_t>& all_asked, PairResult::Kind kind) {
    if (computed.size() == all_asked.size()) {
      separations.swap(computed);
      return;
    }
    separations.resize(all_asked.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < all_asked.size(); ++k) {
      const Item& item = items[all_asked[k]];
      if (known(item) == PairResult::None) {
        separations[k] = computed[next++];
      } else if (known(item) == kind) {
        separations[k] = answers[item.answer].separation;
      } else {
        separations[k] = {-3e38f, Certificate::none()};
      }
    }
  }
};

CertificateFront::CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides, const RevolutionSurface* round_a,
                                   const RevolutionSurface* round_b, Span<const ThreadMatch> threads)
    : a_(&a), b_(&b), round_a_(round_a), round_b_(round_b), threads_(threads), parts_(1), sides_(sides) {
  DISMANTLE_EXPECT(!a.empty() && !b.empty());
  parts_[0].append({0, 0}, Certificate::none());
}

std::size_t CertificateFront::size() const {
  std::size_t sum = 0;
  for (const CertificatePart& part : parts_) sum += part.size();
  return sum;
}

bool CertificateFront::judges(const Mat3& rotation) const {
  return sides_ != SideRule::Normals || turn_between(judged_, rotation) <= kMaxTurn;
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
  sweep.fit_spread = motion.fit_spread;
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
    sweep.rounds = b_moves_ ? std::make_unique<RadialSweeps>(*round_b_, b_->origin, *round_a_, a_->origin, motion)
                            : std::make_unique<RadialSweeps>(*round_a_, a_->origin, *round_b_, b_->origin, motion);
  if (sides_ == SideRule::Memory) return sweep;
  for (const ThreadMatch& match : threads_) {
    const ThreadSweep thread(match, b_moves_ ? 1 : 0, motion);
    if (thread.useful()) sweep.threads.push_back(thread);
  }
  return sweep;
}

FrontSweep CertificateFront::sweep_part(std::size_t index, const PreparedSweep& sweep, const FrontKernels& kernels,
                                        const TrianglePairTest& test, const PartResults* answers) {
  CertificatePart& part = parts_[index];
  FrontSweep result;
  Work work;
  if (answers) {
    take_failing(part, sweep, *answers, work, result);
  } else {
    find_failing(part, sweep, kernels, work, result);
  }
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
  result.min_gap = std::min(result.min_gap, check.min_gap);
  result.touching |= sides_ != SideRule::Normals && check.min_gap < sweep.meeting;
  for (std::size_t k = 0; k < check.failing; ++k) add_item(part, work.failing[k], sweep, work);
  work.of_front = work.items.size();
}

void CertificateFront::take_failing(const CertificatePart& part, const PreparedSweep& sweep, const PartResults& answers,
                                    Work& work, FrontSweep& result) const {
  DISMANTLE_EXPECT(sweep.judged);
  result.min_gap = std::min(result.min_gap, answers.min_gap);
  result.touching |= sides_ != SideRule::Normals && answers.min_gap < sweep.meeting;
  work.answers = answers.answers;
  for (const std::uint32_t root : answers.roots) {
    add_item(part, answers.answers[root].place, sweep, work);
    work.items.back().answer = root;
  }
  work.of_front = work.items.size();
}

void CertificateFront::add_item(const CertificatePart& part, std::uint32_t place, const PreparedSweep& sweep,
                                Work& work) const {
  Item item;
  item.a = part.pair(place).a;
  item.b = part.pair(place).b;
  item.place = place;
  item.origin = static_cast<std::uint32_t>(work.items.size());
  item.hint = hint_of(part, place, sweep);
  item.round = part.kind(place) == NodeHull::kNone;
  item.of_triangles = part.kind(place) > NodeHull::kBox;
  item.on_edge = part.kind(place) == NodeHull::kTriangleOnEdge;
  work.items.push_back(item);
}

FrontSweep CertificateFront::look(const PreparedSweep& sweep, const FrontKernels& kernels,
                                  const TrianglePairTest& test) const {
  FrontSweep result;
  for (const CertificatePart& part : parts_) {
    Work work;
    find_failing(part, sweep, kernels, work, result);
    if (!work.items.empty()) resolve(work, sweep, kernels, test, result);
  }
  return result;
}

Vec3f CertificateFront::hint_of(const CertificatePart& part, std::size_t i, const LinearSweep& sweep) const {
  return sides_ == SideRule::Memory ? trees().hint_of(part.certificate(i), sweep) : Vec3f{};
}

void CertificateFront::resolve(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                               const TrianglePairTest& test, FrontSweep& result) const {
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
    fetch_round(work, opened, k, sweep);
    const std::uint32_t i = opened[k];
    const std::uint32_t a = work.items[i].a, b = work.items[i].b;
    if (parts_round(a, b, sweep, result)) {
      work.prove(work.items[i], Certificate::of_round());
    } else if (std::optional<CylinderFit> held = fit(a, b, sweep)) {
      result.fits.push_back(*held);
      result.complete = false;
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
    work.asked.push_back(i);
    if (work.known(item) != PairResult::None) continue;
    work.queries.push_back(trees().box_query(item.a, item.b, item.hint));
    // Nodes lie far apart: the kernel would wait for each.
    __builtin_prefetch(work.queries.back().a);
    __builtin_prefetch(work.queries.back().b);
  }
  work.computed.resize(work.queries.size());
  if (!work.queries.empty())
    kernels.separate_boxes(work.queries.data(), work.queries.size(), sweep, work.computed.data());
  work.join(work.asked, PairResult::Boxes);
}

void CertificateFront::separate_triangles(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const {
  work.triangle_queries.clear();
  for (const std::uint32_t i : work.triangles_asked) {
    const Item& item = work.items[i];
    if (work.known(item) != PairResult::None) continue;
    work.triangle_queries.push_back(trees().triangle_query(item.a, item.b, item.hint));
    __builtin_prefetch(work.triangle_queries.back().a);
    __builtin_prefetch(work.triangle_queries.back().b);
  }
  work.computed.resize(work.triangle_queries.size());
  if (!work.triangle_queries.empty())
    kernels.separate_triangles(work.triangle_queries.data(), work.triangle_queries.size(), sweep, work.computed.data());
  work.join(work.triangles_asked, PairResult::Triangles);
}

bool CertificateFront::take(Work& work, Item& item, const NodeSeparation& separation, const LinearSweep& sweep,
                            FrontSweep& result) const {
  if (!trees().certifies(separation, item.hint, item.on_edge, sweep)) return false;
  result.min_gap = std::min(result.min_gap, separation.gap);
  result.touching |= trees().may_meet(separation, sweep);
  work.prove(item, separation.certificate);
  return true;
}

bool CertificateFront::parts_round(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep,
                                   FrontSweep& result) const {
  for (const ThreadSweep& thread : sweep.threads) {
    const double gap = b_moves_ ? thread.gap(b, a) : thread.gap(a, b);
    if (gap < sweep.error) continue;  // it is of the true paths, which need no room for arcs
    result.min_gap = std::min(result.min_gap, -rounded_up(-gap));
    return true;
  }
  if (!sweep.rounds) return false;
  for (const RadialSweep& round : sweep.rounds->get()) {
    const RadialSweep::Gap found = b_moves_ ? round.gap(b, a, sweep.limit) : round.gap(a, b, sweep.limit);
    const double limit = sides_ == SideRule::Free || found.facing ? sweep.limit : sweep.meeting;
    if (found.gap < limit) continue;
    result.min_gap = std::min(result.min_gap, -rounded_up(-found.gap));
    result.touching |= found.gap < sweep.meeting && !(sides_ == SideRule::Normals && found.face_on);
    return true;
  }
  return false;
}

void CertificateFront::fetch_round(const Work& work, const std::vector<std::uint32_t>& list, std::size_t k,
                                   const PreparedSweep& sweep) const {
  constexpr std::size_t kNear = 6, kFar = 12;
  for (const ThreadSweep& thread : sweep.threads) {
    if (k + kFar < list.size()) {
      const Item& item = work.items[list[k + kFar]];
      b_moves_ ? thread.fetch_places(item.b, item.a) : thread.fetch_places(item.a, item.b);
    }
    if (k + kNear < list.size()) {
      const Item& item = work.items[list[k + kNear]];
      b_moves_ ? thread.fetch(item.b, item.a) : thread.fetch(item.a, item.b);
    }
  }
}

double CertificateFront::round_gap(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const {
  double most = -std::numeric_limits<double>::infinity();
  if (!sweep.rounds) return most;
  for (const RadialSweep& round : sweep.rounds->get())
    most = std::max(most, (b_moves_ ? round.gap(b, a, most) : round.gap(a, b, most)).gap);
  return most;
}

std::optional<CylinderFit> CertificateFront::fit(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const {
  if (sweep.fit_spread < 0 || !sweep.rounds) return std::nullopt;
  for (const RadialSweep& round : sweep.rounds->get())
    if (std::optional<CylinderFit> found =
            b_moves_ ? round.fit(b, a, sweep.fit_spread) : round.fit(a, b, sweep.fit_spread))
      return found;
  return std::nullopt;
}

void CertificateFront::resolve_batch(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels,
                                     const TrianglePairTest& test, FrontSweep& result) const {
  std::size_t left = 0;
  for (std::size_t k = 0; k < work.batch.size(); ++k) {
    fetch_round(work, work.batch, k, sweep);
    Item& item = work.items[work.batch[k]];
    if (parts_round(item.a, item.b, sweep, result)) {
      work.prove(item, Certificate::of_round());
    } else {
      work.batch[left++] = work.batch[k];
    }
  }
  work.batch.resize(left);
  separate_boxes(work, sweep, kernels);
  work.triangles_asked.clear();
  for (const std::uint32_t i : work.batch)
    if (work.items[i].of_triangles) work.triangles_asked.push_back(i);
  for (std::size_t k = 0; k < work.asked.size(); ++k) {
    const std::uint32_t i = work.asked[k];
    if (take(work, work.items[i], work.separations[k], sweep, result)) continue;
    if (trees().leaves(work.items[i].a, work.items[i].b)) {
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
    item.hint = trees().leaf_hint(item.hint, work.separations[k]);
    test_leaves(work, item, test, result);
  }
}

void CertificateFront::test_leaves(Work& work, Item& item, const TrianglePairTest& test, FrontSweep& result) const {
  ++result.leaf_tests;
  const BoxPairQuery query = trees().box_query(item.a, item.b, {});
  const std::uint32_t answer = item.answer == Item::kNone ? PairResult::kNone : work.answers[item.answer].leaf;
  const TrianglePairVerdict verdict = test(query.a->child, query.b->child, item.hint, answer);
  work.prove(item, verdict.certificate);
  if (!verdict.free || verdict.cut_short) {
    ++result.blocked;
    ++work.blocked[item.start];
  }
  result.min_gap = std::min(result.min_gap, verdict.gap);
  result.touching |= !verdict.harmless;
}

std::uint32_t CertificateFront::split(Work& work, std::uint32_t i) const {
  const Item parent = work.items[i];
  const auto first = static_cast<std::uint32_t>(work.items.size());
  work.items[i].first_child = first;
  const bool splits_of_a = trees().splits_a(parent.a, parent.b);
  const std::uint32_t known =
      work.known(parent) == PairResult::Split ? work.answers[parent.answer].first_child : PairResult::kNone;
  for (std::uint32_t k = 0; k < 2; ++k) {
    Item child = parent;
    child.answer = known == PairResult::kNone ? Item::kNone : known + k;
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
      certificate.offset = length_squared(item.hint) > 0 ? kForgottenCertificate : kNoCertificate;
    }
    if (item.place == Item::kNone) {
      part.append({item.a, item.b}, certificate);
    } else {
      part.set(item.place, {item.a, item.b}, certificate);
    }
  }
}

}  // namespace dismantle
