// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/front/certificate_front.h"

#include "dismantle/certificates/front/front_work.h"
#include "dismantle/core/contract.h"
#include "dismantle/math/vec3f.h"

#include <algorithm>

namespace dismantle {

namespace {

/// Bound of the rounding of a gap in float32, in units of u = 2^-24 times the sum of the coordinates' sizes
/// (docs/design/0006-certificates.md derives 40; the rest is margin).
constexpr double kGapRoundings = 48;

/// If more than one in this many pairs of a part had to be examined, the part searches for siblings often again.
constexpr std::size_t kMuchSplit = 16;

RigidTransformF to_float(const RigidTransform& t) {
  RigidTransformF f;
  for (int i = 0; i < 3; ++i) f.row[i] = to_float(t.rotation.row[i]);
  f.translation = to_float(t.translation);
  return f;
}

/// The largest distance of a point of the tree from its origin [mm].
float reach(const ObbTree& tree) {
  const ObbNode& root = tree.nodes[0];
  return root.radius + length(root.box.center);
}

}  // namespace

CertificateFront::CertificateFront(const ObbTree& a, const ObbTree& b, const RevolutionSurface* surface_a,
                                   const RevolutionSurface* surface_b, Span<const ThreadMatch> threads)
    : a_(&a), b_(&b), surface_a_(surface_a), surface_b_(surface_b), threads_(threads), parts_(1) {
  DISMANTLE_EXPECT(!a.empty() && !b.empty());
  parts_[0].append({0, 0}, Certificate::none());
}

std::size_t CertificateFront::size() const {
  std::size_t sum = 0;
  for (const CertificatePart& part : parts_) sum += part.size();
  return sum;
}

PreparedSweep CertificateFront::prepare_sweep(const PairMotion& motion) const {
  PreparedSweep sweep;
  sweep.t0 = to_float(motion.t0);
  sweep.t1 = to_float(motion.t1);
  for (int i = 0; i < 3; ++i) sweep.middle[i] = to_float(motion.middle.row[i]);
  sweep.max_blocked = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(motion.max_blocked / parts_.size(), kMaxBlockedOfPair, sweep.max_blocked));
  sweep.max_fit_deviation = motion.max_fit_deviation;
  const double size = std::max(length(motion.t0.translation), length(motion.t1.translation)) + reach(*a_) + reach(*b_);
  const double error = kGapRoundings * 0x1p-24 * size;
  sweep.error = static_cast<float>(error);
  sweep.limit = static_cast<float>(-motion.allowed + motion.deviation + error);
  if (surface_a_ && surface_b_)
    sweep.radial = b_moves_ ? std::make_unique<RadialSweeps>(*surface_b_, b_->origin, *surface_a_, a_->origin, motion)
                            : std::make_unique<RadialSweeps>(*surface_a_, a_->origin, *surface_b_, b_->origin, motion);
  for (const ThreadMatch& match : threads_) {
    const ThreadSweep thread(match, b_moves_ ? 1 : 0, motion);
    if (thread.useful()) sweep.threads.push_back(thread);
  }
  return sweep;
}

FrontSweep CertificateFront::sweep_part(std::size_t index, const PreparedSweep& sweep, const FrontKernels& kernels,
                                        const TrianglePairTest& test, const PartResults* known) {
  CertificatePart& part = parts_[index];
  FrontSweep result;
  Work work;
  if (known) {
    take_failing(part, sweep, *known, work, result);
  } else {
    find_failing(part, sweep, kernels, work, result);
  }
  if (work.items.empty()) return result;

  resolve(work, sweep, kernels, test, result);
  if (work.items.size() * kMuchSplit > part.size()) part.set_merge_period(kMergePeriod);
  // A sweep that was cut keeps its results for the next one.
  replace(part, work, result.cut || (result.blocked == 0 && result.complete));
  return result;
}

void CertificateFront::find_failing(const CertificatePart& part, const PreparedSweep& sweep,
                                    const FrontKernels& kernels, Work& work, FrontSweep& result) const {
  work.failing.resize(part.size());
  const CertificateCheck check = kernels.check_certificates(part.blocks(), part.size(), sweep, work.failing.data());
  result.min_gap = std::min(result.min_gap, check.min_gap);
  for (std::size_t k = 0; k < check.failing; ++k)
    if (!still_apart(part, work.failing[k], sweep, result)) add_item(part, work.failing[k], work);
  work.front_count = work.items.size();
}

bool CertificateFront::still_apart(const CertificatePart& part, std::uint32_t slot, const PreparedSweep& sweep,
                                   FrontSweep& result) const {
  if (sweep.threads.empty() || part.kind(slot) != NodeHull::kNone) return false;
  const Vec3f kept = part.center(slot);
  for (const ThreadSweep& thread : sweep.threads) {
    if (static_cast<float>(&thread.match() - threads_.data()) != kept.x) continue;
    const double gap = thread.kept_gap(kept.y, kept.z);
    if (!(gap >= static_cast<double>(sweep.error))) return false;
    result.min_gap = std::min(result.min_gap, -rounded_up(-gap));
    return true;
  }
  return false;
}

void CertificateFront::take_failing(const CertificatePart& part, const PreparedSweep& sweep, const PartResults& known,
                                    Work& work, FrontSweep& result) const {
  result.min_gap = std::min(result.min_gap, known.min_gap);
  work.known_pairs = known.pairs;
  work.known_tests = known.tests;
  for (const std::uint32_t root : known.roots) {
    if (still_apart(part, known.pairs[root].slot, sweep, result)) continue;
    add_item(part, known.pairs[root].slot, work);
    work.items.back().known = root;
  }
  work.front_count = work.items.size();
}

void CertificateFront::add_item(const CertificatePart& part, std::uint32_t slot, Work& work) {
  Item item;
  item.a = part.pair(slot).a;
  item.b = part.pair(slot).b;
  item.slot = slot;
  item.radial = part.kind(slot) == NodeHull::kNone;
  item.are_triangles = part.kind(slot) > NodeHull::kBox;
  work.items.push_back(item);
}

FrontSweep CertificateFront::sweep_const(const PreparedSweep& sweep, const FrontKernels& kernels,
                                         const TrianglePairTest& test) const {
  FrontSweep result;
  for (const CertificatePart& part : parts_) {
    Work work;
    work.keeps = false;
    find_failing(part, sweep, kernels, work, result);
    if (!work.items.empty()) resolve(work, sweep, kernels, test, result);
  }
  return result;
}

void CertificateFront::replace(CertificatePart& part, const Work& work, bool free) {
  for (std::uint32_t i = 0; i < work.items.size(); ++i) {
    const Item& item = work.items[i];
    if (item.first_child != Item::kNone || (item.radial && !free)) continue;
    Certificate certificate = Certificate::none();
    if (item.proof != Item::kNone) {
      certificate = work.proofs[item.proof];
    } else if (i < work.front_count) {
      continue;  // stays as it was
    }
    if (item.slot == Item::kNone) {
      part.append({item.a, item.b}, certificate);
    } else {
      part.set(item.slot, {item.a, item.b}, certificate);
    }
  }
}

}  // namespace dismantle
