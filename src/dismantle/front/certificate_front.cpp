// SPDX-License-Identifier: Apache-2.0
#include "dismantle/front/certificate_front.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

/// Padding of a part's arrays: the widest kernel's lanes.
constexpr std::size_t kPadding = 16;
/// Parts of more pairs than this are cut in two.
constexpr std::size_t kLargestPart = 4096;
/// Every part looks for siblings to merge each so many sweeps.
constexpr std::size_t kMergePeriod = 16;
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

/// How far behind a plane a normal may point and still count as ahead of it: faces seen edge-on.
constexpr float kAheadSine = 0.05f;

/// True where every normal of the cone points ahead along `w` (unit).
bool all_ahead(Vec3f w, Vec3f axis, float cosine) {
  if (cosine <= 0) return false;
  const float along = dot(w, axis);
  const float across = std::sqrt(std::max(0.0f, 1 - along * along)),
              sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  return along * cosine - across * sine >= -kAheadSine;
}

}  // namespace

Certificate CertificateFront::Part::certificate(std::size_t i) const {
  Certificate c;
  c.axis = {fields[0][i], fields[1][i], fields[2][i]};
  c.point = {fields[3][i], fields[4][i], fields[5][i]};
  c.offset = fields[6][i];
  c.radius = fields[7][i];
  c.epoch = static_cast<std::uint32_t>(fields[8][i]);
  return c;
}

void CertificateFront::Part::set(std::size_t i, const Certificate& c) {
  const float values[9] = {
      c.axis.x, c.axis.y, c.axis.z, c.point.x, c.point.y, c.point.z, c.offset, c.radius, static_cast<float>(c.epoch)};
  for (std::size_t k = 0; k < 9; ++k) fields[k][i] = values[k];
}

void CertificateFront::Part::append(std::uint32_t node_a, std::uint32_t node_b, const Certificate& c) {
  a.push_back(node_a);
  b.push_back(node_b);
  for (std::vector<float>& field : fields) field.resize(a.size());
  set(a.size() - 1, c);
}

void CertificateFront::Part::pad() {
  for (std::vector<float>& field : fields) field.resize((size() + kPadding - 1) / kPadding * kPadding);
}

CertificateArrays CertificateFront::Part::arrays() const {
  return {{fields[0].data(), fields[1].data(), fields[2].data()},
          {fields[3].data(), fields[4].data(), fields[5].data()},
          fields[6].data(),
          fields[7].data(),
          fields[8].data()};
}

/// What a part's sweep works on.
struct CertificateFront::Work {
  std::vector<float> least;          // gaps, a pair of the part
  std::vector<std::size_t> failing;  // indices into the part
  std::vector<Item> items;           // the failing ones, in order, then their descendants
};

CertificateFront::CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides)
    : a_(&a), b_(&b), parts_(1), sides_(sides) {
  DISMANTLE_EXPECT(!a.empty() && !b.empty());
  Certificate nothing;
  nothing.offset = kNoCertificate;
  parts_[0].append(0, 0, nothing);
  parts_[0].pad();
}

std::size_t CertificateFront::size() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.size();
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
  Part& part = parts_[index];
  FrontSweep result;
  if ((sweeps_ + index) % kMergePeriod == kMergePeriod - 1) merge(part, sweep, kernels);

  Work work;
  find_failing(part, sweep, kernels, work, result);
  if (work.failing.empty()) return result;

  resolve(work, sweep, kernels, test, result);
  if (work.items.size() > work.failing.size()) {
    replace(part, work.failing, work.items);
    part.pad();
  } else {
    for (std::size_t k = 0; k < work.failing.size(); ++k) part.set(work.failing[k], work.items[k].certificate);
  }
  return result;
}

void CertificateFront::find_failing(const Part& part, const PairSweep& sweep, const FrontKernels& kernels, Work& work,
                                    FrontSweep& result) const {
  std::vector<float>& least = work.least;
  least.resize(part.fields[0].size());
  kernels.check_certificates(part.arrays(), part.size(), sweep, least.data());
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (least[i] >= sweep.limit) {
      result.least_gap = std::min(result.least_gap, least[i]);
      continue;
    }
    const Certificate old = part.certificate(i);
    Item item{part.a[i], part.b[i], guard_of(old, sweep), false, 0, old};
    item.old_leaves = old.offset > kNoCertificate && a_->nodes[item.a].leaf() && b_->nodes[item.b].leaf();
    if (item.old_leaves) item.guard = old.axis;
    work.failing.push_back(i);
    work.items.push_back(item);
  }
}

FrontSweep CertificateFront::look(const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test) const {
  FrontSweep result;
  for (const Part& part : parts_) {
    Work work;
    find_failing(part, sweep, kernels, work, result);
    if (!work.failing.empty()) resolve(work, sweep, kernels, test, result);
  }
  return result;
}

Vec3f CertificateFront::guard_of(const Certificate& c, const PairSweep& sweep) const {
  if (!(c.offset > kNoCertificate)) return {};
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
      queries.push_back(query(item.a, item.b, item.guard));
      asked.push_back(i);
    }
    separations.resize(queries.size());
    if (!queries.empty()) kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());
    for (std::size_t k = 0; k < asked.size(); ++k) {
      Item& item = work.items[asked[k]];
      face(separations[k], item.a, item.b, sweep);
      if (separations[k].gap >= sweep.limit) {
        result.least_gap = std::min(result.least_gap, separations[k].gap);
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
  const LeafVerdict verdict = test(moving_face(item.a, item.b), fixed_face(item.a, item.b), item.guard);
  item.certificate = verdict.certificate;
  item.certificate.epoch = epoch_;
  if (!verdict.free) ++result.blocked;
}

void CertificateFront::descend(std::vector<Item>& items, std::size_t i) const {
  const Item parent = items[i];
  items[i].first_child = static_cast<std::uint32_t>(items.size());
  const ObbNode& a = a_->nodes[parent.a];
  const ObbNode& b = b_->nodes[parent.b];
  for (std::uint32_t k = 0; k < 2; ++k) {
    Item child = parent;
    if (splits_a(a, b)) {
      child.a = a.child + k;
    } else {
      child.b = b.child + k;
    }
    items.push_back(child);
  }
}

void CertificateFront::replace(Part& part, const std::vector<std::size_t>& failing, const std::vector<Item>& items) {
  Part next;
  std::vector<std::size_t> waiting;
  std::size_t k = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (k == failing.size() || failing[k] != i) {
      next.append(part.a[i], part.b[i], part.certificate(i));
      continue;
    }
    waiting.assign(1, k++);
    while (!waiting.empty()) {
      const Item& item = items[waiting.back()];
      waiting.pop_back();
      if (item.first_child == 0) {
        next.append(item.a, item.b, item.certificate);
      } else {
        waiting.push_back(item.first_child + 1);
        waiting.push_back(item.first_child);
      }
    }
  }
  part = std::move(next);
}

void CertificateFront::merge(Part& part, const PairSweep& sweep, const FrontKernels& kernels) const {
  std::vector<BoxPairQuery> queries;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parents;
  std::vector<std::size_t> first;  // of the two siblings of each query
  for (std::size_t i = 0; i + 1 < part.size(); ++i) {
    const std::uint32_t up_a = a_->nodes[part.a[i]].parent, up_b = b_->nodes[part.b[i]].parent;
    if (up_a == ObbNode::kNone && up_b == ObbNode::kNone) continue;
    // The larger parent was split first: the last split was that of the other.
    const bool split_a =
        up_b == ObbNode::kNone || (up_a != ObbNode::kNone && !splits_a(a_->nodes[up_a], b_->nodes[up_b]));
    std::uint32_t a = part.a[i], b = part.b[i];
    if (split_a) {
      if (part.a[i] != a_->nodes[up_a].child || part.a[i + 1] != part.a[i] + 1 || part.b[i + 1] != part.b[i]) continue;
      a = up_a;
    } else {
      if (part.b[i] != b_->nodes[up_b].child || part.b[i + 1] != part.b[i] + 1 || part.a[i + 1] != part.a[i]) continue;
      b = up_b;
    }
    // Siblings on different sides of the same thing stay apart; one side is handed on.
    const Vec3f one = guard_of(part.certificate(i), sweep), other = guard_of(part.certificate(i + 1), sweep);
    if (sides_ == SideRule::Memory && dot(one, other) < 0) continue;
    queries.push_back(query(a, b, length_squared(one) > 0 ? one : other));
    parents.push_back({a, b});
    first.push_back(i);
    ++i;
  }
  if (queries.empty()) return;
  std::vector<BoxSeparation> separations(queries.size());
  kernels.separate_boxes(queries.data(), queries.size(), sweep, separations.data());
  for (std::size_t k = 0; k < queries.size(); ++k) face(separations[k], parents[k].first, parents[k].second, sweep);

  Part next;
  std::size_t k = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    while (k < first.size() && first[k] < i) ++k;
    if (k < first.size() && first[k] == i && separations[k].gap >= sweep.limit) {
      next.append(parents[k].first, parents[k].second, separations[k].certificate);
      ++i;
    } else {
      next.append(part.a[i], part.b[i], part.certificate(i));
    }
  }
  if (next.size() == part.size()) return;
  part = std::move(next);
  part.pad();
}

void CertificateFront::end_sweep() {
  ++sweeps_;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    while (parts_[p].size() > kLargestPart) {
      Part& part = parts_[p];
      Part rest;
      const std::size_t half = part.size() / 2;
      for (std::size_t i = half; i < part.size(); ++i) rest.append(part.a[i], part.b[i], part.certificate(i));
      part.a.resize(half);
      part.b.resize(half);
      part.pad();
      rest.pad();
      parts_.insert(parts_.begin() + static_cast<std::ptrdiff_t>(p) + 1, std::move(rest));
    }
  }
  // A part that merging has left small joins the one before it.
  for (std::size_t p = 1; p < parts_.size();) {
    Part& before = parts_[p - 1];
    const Part& part = parts_[p];
    if (before.size() + part.size() > kLargestPart / 2) {
      ++p;
      continue;
    }
    for (std::size_t i = 0; i < part.size(); ++i) before.append(part.a[i], part.b[i], part.certificate(i));
    before.pad();
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(p));
  }
}

void CertificateFront::exchange_roles(const Mat3& rotation) {
  const Mat3 back = transposed(rotation);
  for (Part& part : parts_)
    for (std::size_t i = 0; i < part.size(); ++i) {
      Certificate c = part.certificate(i);
      const Vec3f axis = c.axis;
      c.axis = to_float(-(back * Vec3{axis.x, axis.y, axis.z}));
      part.set(i, c);
    }
  b_moves_ = !b_moves_;
  forget();
}

void CertificateFront::forget() {
  for (Part& part : parts_)
    for (float& offset : part.fields[6]) offset = std::min(offset, kForgotten);
  epoch_ = 0;
}

}  // namespace dismantle
