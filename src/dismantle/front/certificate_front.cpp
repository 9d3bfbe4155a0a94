// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/certificate_front.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dismantle {

namespace {

/// Parts of more pairs than this are cut in two.
constexpr std::size_t kLargestPart = 4096;
/// Every part looks for siblings to merge each so many sweeps.
constexpr std::size_t kMergePeriod = 8;
/// The offset of a certificate of which only the side is left.
constexpr float kForgotten = -1e29f;
/// Epochs are kept as float: beyond this they would not be exact.
constexpr std::uint32_t kLastEpoch = 1u << 23;
/// Rotations nearer than this [of a unit vector] share a reference.
constexpr double kSameRotation = 1e-7;

/// The rounding of a gap in float32, in units of u = 2^-24 times the sum of the coordinates' sizes (docs/design/
/// 0006-certificates.md derives 40; the rest is margin).
constexpr double kGapRoundings = 48;

Vec3f to_float(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

RigidTransformF to_float(const RigidTransform& t) {
  RigidTransformF f;
  for (int i = 0; i < 3; ++i) f.row[i] = to_float(t.rotation.row[i]);
  f.translation = to_float(t.translation);
  return f;
}

/// An upper bound of how far a unit vector turned by one rotation is from the same turned by the other: the
/// difference's spectral norm, which for rotations is its Frobenius norm over sqrt(2).
float turn_between(const Mat3& a, const Mat3& b) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += length_squared(a.row[i] - b.row[i]);
  return square == 0 ? 0.0f : static_cast<float>(std::sqrt(square / 2) * (1 + 1e-6));
}

float reach(const ObbTree& tree) {
  const ObbNode& root = tree.nodes[0];
  return root.radius + length(root.box.center);
}

/// Which of two nodes the tree of pairs descends into: the larger one; leaves last. True for A.
bool splits_a(const ObbNode& a, const ObbNode& b) {
  return a.size >= b.size;
}

/// Whole nodes may use the allowance only along axes that all their normals face by this cosine: things that lie over
/// each other by their faces. What is seen edge-on is left to pairs of triangles.
constexpr float kLeastAhead = 0.3f;

/// True where every normal of the cone points ahead along `w` (unit).
bool all_ahead(Vec3f w, Vec3f axis, float cosine) {
  if (cosine <= 0) return false;
  const float along = dot(w, axis);
  const float across = std::sqrt(std::max(0.0f, 1 - along * along)),
              sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  return along * cosine - across * sine >= kLeastAhead;
}

}  // namespace

/// What a part's sweep works on.
struct CertificateFront::Work {
  std::vector<std::uint32_t> failing;  // indices into the part
  std::vector<Item> items;             // the failing ones, in order, then their descendants
};

CertificateFront::CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides)
    : a_(&a), b_(&b), parts_(1), sides_(sides) {
  DISMANTLE_EXPECT(!a.empty() && !b.empty());
  Certificate nothing;
  nothing.offset = kNoCertificate;
  parts_[0].append(pair_of(0, 0), nothing);
}

std::size_t CertificateFront::size() const {
  std::size_t sum = 0;
  for (const CertificatePart& part : parts_) sum += part.size();
  return sum;
}

PairSweep CertificateFront::begin_sweep(const PairMotion& motion) {
  if (epoch_ == 0 || turn_between(references_[epoch_ % PairSweep::kEpochs], motion.middle) > kSameRotation) {
    if (epoch_ == kLastEpoch) forget();
    ++epoch_;
    references_[epoch_ % PairSweep::kEpochs] = motion.middle;
  }
  return sweep_about(references_[epoch_ % PairSweep::kEpochs], motion);
}

PairSweep CertificateFront::begin_look(const PairMotion& motion) const {
  return sweep_about(motion.middle, motion);
}

PairSweep CertificateFront::sweep_about(const Mat3& middle, const PairMotion& motion) const {
  PairSweep sweep;
  sweep.t0 = to_float(motion.t0);
  sweep.t1 = to_float(motion.t1);
  for (int i = 0; i < 3; ++i) sweep.middle[i] = to_float(middle.row[i]);
  sweep.turn = std::max(turn_between(middle, motion.t0.rotation), turn_between(middle, motion.t1.rotation));
  sweep.epoch = epoch_;
  for (std::uint32_t k = 0; k < PairSweep::kEpochs && k < epoch_; ++k) {
    const std::uint32_t place = (epoch_ - k) % PairSweep::kEpochs;
    sweep.turn_t0[place] = turn_between(references_[place], motion.t0.rotation);
    sweep.turn_t1[place] = turn_between(references_[place], motion.t1.rotation);
  }
  const double size = std::max(length(motion.t0.translation), length(motion.t1.translation)) + reach(*a_) + reach(*b_);
  const double error = kGapRoundings * 0x1p-24 * size;
  sweep.error = static_cast<float>(error);
  sweep.allowed = static_cast<float>(motion.allowed);
  sweep.limit = static_cast<float>(-motion.allowed + motion.deviation + error);
  sweep.apart = static_cast<float>(motion.allowed + motion.deviation + error);
  return sweep;
}

FrontSweep CertificateFront::sweep_part(std::size_t index, const PairSweep& sweep, const FrontKernels& kernels,
                                        const LeafTest& test) {
  CertificatePart& part = parts_[index];
  FrontSweep result;
  if ((sweeps_ + index) % kMergePeriod == kMergePeriod - 1) merge(part, sweep, kernels);

  Work work;
  find_failing(part, sweep, kernels, work, result);
  if (work.items.empty()) return result;

  resolve(work, sweep, kernels, test, result);
  replace(part, work);
  return result;
}

void CertificateFront::find_failing(const CertificatePart& part, const PairSweep& sweep, const FrontKernels& kernels,
                                    Work& work, FrontSweep& result) const {
  work.failing.resize(part.size());
  const CertificateCheck check = kernels.check_certificates(part.arrays(), part.size(), sweep, work.failing.data());
  result.least_gap = std::min(result.least_gap, check.least_gap);
  result.touching |= sides_ != SideRule::Normals && check.least_gap < sweep.apart - sweep.allowed;
  for (std::size_t k = 0; k < check.failing; ++k) {
    const std::size_t i = work.failing[k];
    const Certificate old = part.certificate(i);
    Item item{part.pair(i).a, part.pair(i).b, hint_of(old, sweep), false, 0, i, old};
    item.old_leaves = old.offset > kNoCertificate && a_->nodes[item.a].leaf() && b_->nodes[item.b].leaf();
    if (item.old_leaves) item.hint = old.axis;
    work.items.push_back(item);
  }
}

FrontSweep CertificateFront::look(const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test) const {
  FrontSweep result;
  for (const CertificatePart& part : parts_) {
    Work work;
    find_failing(part, sweep, kernels, work, result);
    if (!work.items.empty()) resolve(work, sweep, kernels, test, result);
  }
  return result;
}

Vec3f CertificateFront::hint_of(const Certificate& c, const PairSweep& sweep) const {
  if (!(c.offset > kNoCertificate)) return {};
  if (sides_ != SideRule::Memory) return c.axis;
  const Vec3f p = c.point;
  const RigidTransformF& t = sweep.t0;
  const Vec3f at{dot(t.row[0], p) + t.translation.x, dot(t.row[1], p) + t.translation.y,
                 dot(t.row[2], p) + t.translation.z};
  const bool known = sweep.epoch - c.epoch < PairSweep::kEpochs;
  const float turn = known ? sweep.turn_t0[c.epoch % PairSweep::kEpochs] : 2.0f;
  return c.offset - dot(c.axis, at) - turn * c.radius < sweep.error ? c.axis : Vec3f{};
}

void CertificateFront::face(BoxSeparation& separation, std::uint32_t a, std::uint32_t b, const PairSweep& sweep) const {
  if (sides_ != SideRule::Normals || separation.gap >= sweep.error || separation.gap < sweep.limit) return;
  const NormalCone& moving = b_moves_ ? b_->cones[b] : a_->cones[a];
  const NormalCone& fixed = b_moves_ ? a_->cones[a] : b_->cones[b];
  const Vec3f turned{dot(sweep.middle[0], moving.axis), dot(sweep.middle[1], moving.axis),
                     dot(sweep.middle[2], moving.axis)};
  const Vec3f w = separation.certificate.axis;
  if (all_ahead(w, turned, moving.cosine) && all_ahead(-w, fixed.axis, fixed.cosine)) return;
  separation.gap -= sweep.allowed;
  separation.certificate.offset -= sweep.allowed;
}

void CertificateFront::resolve(Work& work, const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test,
                               FrontSweep& result) const {
  std::vector<BoxPairQuery> queries;
  std::vector<std::size_t> asked;
  std::vector<BoxSeparation> separations;
  for (std::size_t done = 0; done < work.items.size();) {
    const std::size_t end = work.items.size();
    queries.clear();
    asked.clear();
    for (std::size_t i = done; i < end; ++i) {
      Item& item = work.items[i];
      if (item.old_leaves) {
        test_leaves(item, test, result);
        continue;
      }
      queries.push_back(query(item.a, item.b, item.hint));
      asked.push_back(i);
    }
    separations.resize(queries.size());
    if (!queries.empty()) kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());
    for (std::size_t k = 0; k < asked.size(); ++k) {
      Item& item = work.items[asked[k]];
      face(separations[k], item.a, item.b, sweep);
      if (separations[k].gap >= sweep.limit) {
        result.least_gap = std::min(result.least_gap, separations[k].gap);
        result.touching |= sides_ != SideRule::Normals && separations[k].gap < sweep.apart - sweep.allowed;
        item.certificate = separations[k].certificate;
      } else if (queries[k].a->leaf() && queries[k].b->leaf()) {
        test_leaves(item, test, result);
      } else {
        descend(work.items, asked[k]);
      }
    }
    done = end;
  }
}

void CertificateFront::test_leaves(Item& item, const LeafTest& test, FrontSweep& result) const {
  ++result.leaf_tests;
  const LeafVerdict verdict = test(moving_face(item.a, item.b), fixed_face(item.a, item.b), item.hint);
  item.certificate = verdict.certificate;
  item.certificate.epoch = epoch_;
  if (!verdict.free) ++result.blocked;
  result.least_gap = std::min(result.least_gap, verdict.gap);
  result.touching |= !verdict.harmless;
}

void CertificateFront::descend(std::vector<Item>& items, std::size_t i) const {
  const Item parent = items[i];
  items[i].first_child = static_cast<std::uint32_t>(items.size());
  const ObbNode& a = a_->nodes[parent.a];
  const ObbNode& b = b_->nodes[parent.b];
  for (std::uint32_t k = 0; k < 2; ++k) {
    Item child = parent;
    // The first takes its parent's place, others come behind all.
    if (k > 0) child.place = Item::kNew;
    if (splits_a(a, b)) {
      child.a = a.child + k;
    } else {
      child.b = b.child + k;
    }
    items.push_back(child);
  }
}

void CertificateFront::replace(CertificatePart& part, const Work& work) const {
  for (std::size_t i = 0; i < work.items.size(); ++i) {
    const Item& item = work.items[i];
    if (item.first_child != 0) continue;
    if (item.place == Item::kNew) {
      part.append(pair_of(item.a, item.b), item.certificate);
    } else {
      part.set(item.place, pair_of(item.a, item.b), item.certificate);
    }
  }
}

FrontPair CertificateFront::pair_of(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t up_a = a_->nodes[a].parent, up_b = b_->nodes[b].parent;
  if (up_a == ObbNode::kNone && up_b == ObbNode::kNone) return {a, b, ObbNode::kNone, ObbNode::kNone};
  // The larger parent was split first: the last split was that of the other.
  const bool split_a =
      up_b == ObbNode::kNone || (up_a != ObbNode::kNone && !splits_a(a_->nodes[up_a], b_->nodes[up_b]));
  return split_a ? FrontPair{a, b, up_a, b} : FrontPair{a, b, a, up_b};
}

void CertificateFront::merge(CertificatePart& part, const PairSweep& sweep, const FrontKernels& kernels) const {
  struct Siblings {
    std::uint32_t parent_a, parent_b;
    std::size_t first, second;
  };
  std::vector<Siblings> found;
  std::vector<BoxPairQuery> queries;
  // An open hash table from parents to the first of their children seen.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * part.size() + 2), 0);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const FrontPair& pair = part.pair(i);
    if (pair.parent_a == ObbNode::kNone) continue;
    std::size_t place = (pair.parent_a * 0x9E3779B97F4A7C15ull ^ pair.parent_b * 0xC2B2AE3D27D4EB4Full) >> 20;
    for (;; ++place) {
      std::uint32_t& entry = table[place & (table.size() - 1)];
      if (entry == 0) {
        entry = static_cast<std::uint32_t>(i) + 1;
        break;
      }
      const std::size_t other = entry - 1;
      if (part.pair(other).parent_a != pair.parent_a || part.pair(other).parent_b != pair.parent_b) continue;
      // Siblings on different sides of the same thing stay apart; one side is handed on.
      const Vec3f one = hint_of(part.certificate(other), sweep), two = hint_of(part.certificate(i), sweep);
      if (sides_ == SideRule::Memory && dot(one, two) < 0) break;
      queries.push_back(query(pair.parent_a, pair.parent_b, length_squared(one) > 0 ? one : two));
      found.push_back({pair.parent_a, pair.parent_b, other, i});
      break;
    }
  }
  if (queries.empty()) return;
  std::vector<BoxSeparation> separations(queries.size());
  kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());

  std::vector<std::size_t> gone;
  for (std::size_t k = 0; k < found.size(); ++k) {
    face(separations[k], found[k].parent_a, found[k].parent_b, sweep);
    if (separations[k].gap < sweep.limit) continue;
    part.set(found[k].first, pair_of(found[k].parent_a, found[k].parent_b), separations[k].certificate);
    gone.push_back(found[k].second);
  }
  std::sort(gone.begin(), gone.end());
  for (auto i = gone.rbegin(); i != gone.rend(); ++i) part.remove(*i);
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
  const std::uint32_t border = middle_of(by_a ? of_a : of_b);
  CertificatePart kept, rest;
  for (std::size_t i = 0; i < part.size(); ++i)
    ((by_a ? part.pair(i).a : part.pair(i).b) < border ? kept : rest).append(part.pair(i), part.certificate(i));
  part = std::move(kept);
  return rest;
}

void CertificateFront::end_sweep() {
  ++sweeps_;
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
  epoch_ = 0;
}

}  // namespace dismantle
