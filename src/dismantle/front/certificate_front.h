// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/front/certificate_part.h"
#include "dismantle/math/rigid_transform.h"

#include <array>
#include <functional>
#include <vector>

namespace dismantle {

/// What a test of two triangles says of a sweep.
struct LeafVerdict {
  bool free = true;         ///< They are certainly allowed during all of the sweep.
  float gap = -3e38f;       ///< They are certainly never nearer than this during the sweep [mm]; below 0: may overlap.
  bool harmless = false;    ///< They do not meet at all, or face on face.
  Certificate certificate;  ///< The axis that the test ended on: the one to begin with next time.
};

/// Tests a face of the moving component against one of the fixed component during the sweep at hand, beginning with the
/// axis `hint` (from the moving to the fixed one, the latter's frame; zero for none).
using LeafTest = std::function<LeafVerdict(std::uint32_t moving, std::uint32_t fixed, Vec3f hint)>;

/// The motion of the moving component in the fixed one's frame, in double: between trees' frames as PairSweep has it.
struct PairMotion {
  RigidTransform t0, t1;
  Mat3 middle;           ///< The rotation half way.
  double deviation = 0;  ///< The largest distance of an arc from its chord [mm].
  double allowed = 0;    ///< How deep triangles may be in each other on the true paths [mm].
};

/// What sweeping a part of a front found.
struct FrontSweep {
  float least_gap = 3e38f;     ///< No certified pair came nearer during the sweep [mm].
  std::size_t leaf_tests = 0;  ///< Calls of the LeafTest.
  std::size_t blocked = 0;     ///< Those that were not free.
  /// Some pair was not certainly apart all the time, nor lay face on face: only such pairs can hide a deep vertex, as a
  /// triangle is never deeper across its own plane than it is thin.
  bool touching = false;
};

/// What keeps things on their sides of each other that may be in each other by the allowance (DESIGN section 5).
enum class SideRule {
  /// Closed solids: an axis that uses the allowance has to agree with the outward normals. Any that does may be taken,
  /// so the least blocking one is.
  Normals,
  /// Open sheets: an axis that has used part of the allowance may only be left for one within a right angle of it.
  Memory,
  /// Closed solids that overlap by design, where normals say little: any axis. Their other faces stop what one pair of
  /// faces lets through.
  Free,
};

/// The front of the tree of node pairs of two components (Li, Chen 1998; DESIGN section 2.2), each pair with a
/// certificate that proves it apart. A sweep checks every certificate with a dot product, separates those anew that no
/// longer do, descends where boxes cannot be separated, and now and then merges siblings that their parents can
/// replace. All pairs of triangles are covered at all times, whatever the motion: a front only costs time, never a
/// result. Results do not depend on lanes or threads.
class CertificateFront {
 public:
  /// The pair of the roots; A moves. The trees must outlive the front. @pre neither is empty
  /// @param sides of the two components
  CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides);

  /// How many node pairs it has.
  std::size_t size() const;
  /// A front is swept in parts, which may run side by side.
  std::size_t part_count() const { return parts_.size(); }

  /// Begins a sweep.
  PairSweep begin_sweep(const PairMotion& motion);
  /// The same for look(), which leaves the front as it is.
  PairSweep begin_look(const PairMotion& motion) const;
  FrontSweep sweep_part(std::size_t part, const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test);
  /// As sweeping all parts, but the front stays as it is: any number of motions may be looked at side by side.
  FrontSweep look(const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test) const;
  /// Ends the sweep once all parts are swept: cuts parts that have grown large.
  void end_sweep();

  /// From now on sweeps move B and A stands still, or the other way round. The front stays as it is, certificates are
  /// made anew, and every pair remembers its side.
  /// @param rotation of what moved so far in the frame of what stood still
  void exchange_roles(const Mat3& rotation);
  /// Makes all certificates anew with the next sweep: what stands still was moved.
  void forget();
  /// Calls visit(face of the moving component, face of the fixed one, certificate) for every pair of leaves.
  template <class Visit>
  void for_each_leaf_pair(Visit&& visit) const {
    for (const CertificatePart& part : parts_)
      for (std::size_t i = 0; i < part.size(); ++i)
        if (a_->nodes[part.pair(i).a].leaf() && b_->nodes[part.pair(i).b].leaf())
          visit(moving_face(part.pair(i).a, part.pair(i).b), fixed_face(part.pair(i).a, part.pair(i).b),
                part.certificate(i));
  }

 private:
  /// A pair that has to be looked at, and what comes of it.
  struct Item {
    std::uint32_t a, b;
    Vec3f hint;  // the axis of this pair or the one it came from; where sides are remembered only if it binds
    bool old_leaves = false;        // a pair of leaves that the front had already
    std::uint32_t first_child = 0;  // index of the first of two items; 0: none
    static constexpr std::size_t kNew = static_cast<std::size_t>(-1);
    std::size_t place = kNew;  // in the part
    Certificate certificate;
  };
  struct Work;

  BoxPairQuery query(std::uint32_t a, std::uint32_t b, Vec3f guard) const {
    const ObbNode* node_a = &a_->nodes[a];
    const ObbNode* node_b = &b_->nodes[b];
    if (sides_ != SideRule::Memory) guard = {};
    return b_moves_ ? BoxPairQuery{node_b, node_a, guard} : BoxPairQuery{node_a, node_b, guard};
  }
  std::uint32_t moving_face(std::uint32_t a, std::uint32_t b) const { return query(a, b, {}).a->child; }
  std::uint32_t fixed_face(std::uint32_t a, std::uint32_t b) const { return query(a, b, {}).b->child; }
  PairSweep sweep_about(const Mat3& middle, const PairMotion& motion) const;
  /// The pairs of a part that do not hold, as items to be resolved.
  void find_failing(const CertificatePart& part, const PairSweep& sweep, const FrontKernels& kernels, Work& work,
                    FrontSweep& result) const;
  Vec3f hint_of(const Certificate& certificate, const PairSweep& sweep) const;
  /// Takes the allowance from what only holds by it against the normals of closed solids.
  void face(BoxSeparation& separation, std::uint32_t a, std::uint32_t b, const PairSweep& sweep) const;
  /// The pair of these nodes, with the one whose split made it.
  FrontPair pair_of(std::uint32_t a, std::uint32_t b) const;
  void merge(CertificatePart& part, const PairSweep& sweep, const FrontKernels& kernels) const;
  void resolve(Work& work, const PairSweep& sweep, const FrontKernels& kernels, const LeafTest& test,
               FrontSweep& result) const;
  void test_leaves(Item& item, const LeafTest& test, FrontSweep& result) const;
  void descend(std::vector<Item>& items, std::size_t i) const;
  void replace(CertificatePart& part, const Work& work) const;
  /// Cuts the part in two of about the same size, siblings together.
  CertificatePart cut(CertificatePart& part) const;

  const ObbTree* a_;
  const ObbTree* b_;
  std::vector<CertificatePart> parts_;
  std::array<Mat3, PairSweep::kEpochs> references_;
  std::uint32_t epoch_ = 0;
  std::size_t sweeps_ = 0;
  bool b_moves_ = false;
  SideRule sides_;
};

}  // namespace dismantle
