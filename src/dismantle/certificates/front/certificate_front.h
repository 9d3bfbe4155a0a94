// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_part.h"
#include "dismantle/certificates/front/front_results.h"
#include "dismantle/certificates/front/paired_trees.h"
#include "dismantle/certificates/front/radial_separation.h"
#include "dismantle/certificates/front/thread_separation.h"
#include "dismantle/math/rigid_transform.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// What a test of two triangles says of a sweep.
struct TrianglePairVerdict {
  bool free = true;    ///< They are certainly allowed during all of the sweep.
  float gap = -3e38f;  ///< They are certainly never nearer than this during the sweep [mm]; below 0: may overlap.
  /// What comes after some time was not looked at, and may block.
  bool cut_short = false;
  bool harmless = false;    ///< They do not meet at all, or face on face.
  Certificate certificate;  ///< The axis that the test ended on: the one to begin with next time.
};

/// Tests a face of the moving component against one of the fixed component during the sweep at hand, beginning with the
/// axis `hint` (from the moving to the fixed one, the latter's frame; zero for none). `answer` is that of PairResult:
/// where the device found what the test would find.
using TrianglePairTest =
    std::function<TrianglePairVerdict(std::uint32_t moving, std::uint32_t fixed, Vec3f hint, std::uint32_t answer)>;

/// A motion as a front takes it.
struct PreparedSweep : LinearSweep {
  std::unique_ptr<const RadialSweeps> rounds;  ///< Null where there are none.
  double fit_spread = -1;                      ///< As PairMotion has it.
  std::vector<ThreadSweep> threads;
};

/// What sweeping a part of a front found.
struct FrontSweep {
  float min_gap = 3e38f;       ///< No certified pair came nearer during the sweep [mm].
  std::size_t leaf_tests = 0;  ///< Calls of the TrianglePairTest.
  std::size_t blocked = 0;     ///< Those that were not free.
  bool complete = true;        ///< Nothing was left unlooked at.
  /// Cylinders that their bores hold back, which were not opened: the motion is not free.
  std::vector<CylinderFit> fits;
  /// Some pair was not certainly apart all the time, nor lay face on face: only such pairs can hide a deep vertex, as a
  /// triangle is never deeper across its own plane than it is thin.
  bool touching = false;
};

/// Two pairs of a part of a front that are the halves of one.
struct Siblings {
  FrontPair parent;
  Vec3f hint;                           ///< Of the side that either is bound to; zero for none.
  std::uint32_t first = 0, second = 0;  ///< Their places.
};

/// The front of the tree of node pairs of two components (Li, Chen 1998; docs/design/0006-certificates.md), each pair
/// with a certificate that proves it apart. A sweep checks every certificate with a dot product, separates those anew
/// that no longer do, descends where boxes cannot be separated, and now and then merges siblings that their parents can
/// replace. All pairs of triangles are covered at all times, whatever the motion: a front only costs time, never a
/// result. Results do not depend on lanes or threads.
class CertificateFront {
 public:
  /// The pair of the roots; A moves. The trees must outlive the front. @pre neither is empty
  /// @param sides of the two components
  /// @param round_a, round_b what is round of them, if it is known
  /// @param threads of A in or around those of B, if there are any; must outlive the front
  CertificateFront(const ObbTree& a, const ObbTree& b, SideRule sides, const RevolutionSurface* round_a = nullptr,
                   const RevolutionSurface* round_b = nullptr, Span<const ThreadMatch> threads = {});

  /// How many node pairs it has.
  std::size_t size() const;
  /// A front is swept in parts, which may run side by side.
  std::size_t part_count() const { return parts_.size(); }

  /// Begins a sweep.
  PreparedSweep begin_sweep(const PairMotion& motion);
  /// The same for look(), which leaves the front as it is.
  PreparedSweep begin_look(const PairMotion& motion) const;
  /// Now and then gathers what went fine: to be called before each sweep_part().
  void merge_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels);
  /// What merge_part() looks at first, if this is the time for it; else nothing.
  std::vector<Siblings> siblings_of(std::size_t part, const PreparedSweep& sweep) const;
  /// As merge_part(), with what a device found of siblings_of(): the separations of their parents as boxes.
  void merge_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels,
                  Span<const Siblings> siblings, Span<const NodeSeparation> separations);
  /// @param answers of a device that this sweep was asked of after merging, if any was: the result is the same
  FrontSweep sweep_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels,
                        const TrianglePairTest& test, const PartResults* answers = nullptr);
  /// As sweeping all parts, but the front stays as it is: any number of motions may be looked at side by side.
  FrontSweep look(const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test) const;
  /// Ends the sweep once all parts are swept: cuts parts that have grown large.
  /// @param free no pair was found blocked, and none left unlooked at
  void end_sweep(const PreparedSweep& sweep, bool free);

  /// From now on sweeps move B and A stands still, or the other way round. The front stays as it is, certificates are
  /// made anew, and every pair remembers its side.
  /// @param rotation of what moved so far in the frame of what stood still
  void exchange_roles(const Mat3& rotation);
  /// Makes all certificates anew with the next sweep: what stands still was moved.
  void forget();

  // For a device, which keeps copies of all this.
  const ObbTree& tree_a() const { return *a_; }
  const ObbTree& tree_b() const { return *b_; }
  PairedTrees trees() const {
    return {{a_->nodes.data(), a_->cones.data(), a_->triangles.data()},
            {b_->nodes.data(), b_->cones.data(), b_->triangles.data()},
            sides_,
            b_moves_};
  }
  CertificatePart& part(std::size_t index) { return parts_[index]; }

 private:
  /// A pair that has to be looked at, and what comes of it.
  struct Item {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t a = 0, b = 0;
    Vec3f hint;                         ///< The axis to begin with; where sides are remembered only if it binds.
    std::uint32_t place = kNone;        ///< In the part; none for what comes behind all.
    std::uint32_t first_child = kNone;  ///< Index of the first of two items that replace it.
    std::uint32_t proof = kNone;        ///< Index of its certificate; none for what was left unlooked at.
    std::uint32_t origin = 0;           ///< Index of the pair of the front that it comes from,
    std::uint32_t start = 0;            ///< and of that which the search began with, among all of these.
    std::uint32_t answer = kNone;       ///< Index of what a device says of it, if it does.
    bool round = false;                 ///< The front's pair was parted as round the last time.
    bool of_triangles = false;          ///< The front tested these triangles before,
    bool on_edge = false;               ///< and found that they are in each other on edge.
  };
  struct Work;

  /// Whether certificates that face along the normals still do with A turned like this.
  bool judges(const Mat3& rotation) const;
  /// The pairs of a part that do not hold, as items to be resolved.
  void find_failing(const CertificatePart& part, const PreparedSweep& sweep, const FrontKernels& kernels, Work& work,
                    FrontSweep& result) const;
  /// The same from what a device found.
  void take_failing(const CertificatePart& part, const PreparedSweep& sweep, const PartResults& answers, Work& work,
                    FrontSweep& result) const;
  void add_item(const CertificatePart& part, std::uint32_t place, const PreparedSweep& sweep, Work& work) const;
  /// The axis of pair i where it binds the pair to its side; zero otherwise.
  Vec3f hint_of(const CertificatePart& part, std::size_t i, const LinearSweep& sweep) const;
  /// Whether this is the time for a part to merge.
  bool merges(std::size_t part) const;
  std::vector<Siblings> find_siblings(const CertificatePart& part, const PreparedSweep& sweep) const;
  std::vector<NodeSeparation> separate_parents(Span<const Siblings> siblings, const PreparedSweep& sweep,
                                               const FrontKernels& kernels) const;
  /// Replaces siblings by their parents where these are separated; gives how many pairs went.
  std::size_t merge(CertificatePart& part, const PreparedSweep& sweep, Span<const Siblings> siblings,
                    Span<const NodeSeparation> separations) const;
  void resolve(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test,
               FrontSweep& result) const;
  /// The items to begin with, the first one last. What was parted as round, and is not any more, is opened to some
  /// pairs all over it, and those that come nearest are looked at before all others.
  std::vector<std::uint32_t> find_starts(Work& work, const PreparedSweep& sweep, FrontSweep& result) const;
  void resolve_batch(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test,
                     FrontSweep& result) const;
  void separate_boxes(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const;
  void separate_triangles(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const;
  /// Whether the two are apart as surfaces that turn about one axis, or as threads. They get no certificate: what
  /// proves it costs next to nothing, and holds for large nodes.
  bool parts_round(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep, FrontSweep& result) const;
  /// Asks for the memory that parts_round() needs of items list[k + ...], which lies all over the trees.
  void fetch_round(const Work& work, const std::vector<std::uint32_t>& list, std::size_t k,
                   const PreparedSweep& sweep) const;
  /// The most that any pair of axes leaves between two nodes [mm].
  double round_gap(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const;
  /// The two as a cylinder in a bore, if the sweep asks for that and they are.
  std::optional<CylinderFit> fit(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const;
  /// Keeps what certifies the item; false where it does not.
  bool take(Work& work, Item& item, const NodeSeparation& separation, const LinearSweep& sweep,
            FrontSweep& result) const;
  void test_leaves(Work& work, Item& item, const TrianglePairTest& test, FrontSweep& result) const;
  /// Replaces an item by the halves of a node; gives the index of the first.
  std::uint32_t split(Work& work, std::uint32_t i) const;
  /// What was parted as round stays whole in a sweep that is not free: the next one is another.
  void replace(CertificatePart& part, const Work& work, bool free) const;
  /// Replaces what lies below pairs of large nodes that are parted as round.
  void merge_round(const PreparedSweep& sweep);
  /// Cuts the part in two of about the same size, siblings together.
  CertificatePart cut(CertificatePart& part) const;

  const ObbTree* a_;
  const ObbTree* b_;
  const RevolutionSurface* round_a_;
  const RevolutionSurface* round_b_;
  Span<const ThreadMatch> threads_;
  std::vector<CertificatePart> parts_;
  Mat3 judged_;  ///< The rotation about which certificates were judged to face along the normals.
  std::size_t sweeps_ = 0;
  std::size_t blocked_ = 0;  ///< Sweeps that were not free since merge_round().
  bool b_moves_ = false;
  SideRule sides_;
};

}  // namespace dismantle
