// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/front/certificate_part.h"
#include "dismantle/certificates/front/front_results.h"
#include "dismantle/certificates/front/paired_trees.h"
#include "dismantle/certificates/front/radial_separation.h"
#include "dismantle/certificates/front/thread_separation.h"
#include "dismantle/math/rigid_transform.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dismantle {

/// Two triangles that a front could not separate, to be tested for the sweep.
struct TrianglePairCandidate {
  std::uint32_t face_moving = 0;              ///< Face of the moving component.
  std::uint32_t face_fixed = 0;               ///< Face of the fixed component.
  Vec3f hint;                                 ///< Axis to start with, from the moving to the fixed triangle.
  const TrianglePairResult* known = nullptr;  ///< A device's result for the whole sweep; null if it has none.
};

/// The part of a triangle pair's test result that a front uses.
struct TrianglePairVerdict {
  bool free = true;    ///< The two are certainly allowed during all of the sweep.
  float gap = -3e38f;  ///< Lower bound of their distance during the sweep [mm]; below 0: they may overlap.
  /// True if the test ended before the end of the sweep, so that the two may block later on.
  bool cut_short = false;
  Certificate certificate;  ///< Of the axis that the test ended with.
};

/// Tests two triangles for the sweep at hand.
using TrianglePairTest = std::function<TrianglePairVerdict(const TrianglePairCandidate&)>;

/// A motion in the form that fronts use.
struct PreparedSweep : LinearSweep {
  std::unique_ptr<const RadialSweeps> radial;  ///< Separation by radii; null if it cannot be used.
  double max_fit_deviation = -1;               ///< As PairMotion::max_fit_deviation [mm].
  std::vector<ThreadSweep> threads;            ///< Separation of mating threads; those that are useful.
  /// sweep_const() ends soon after so many tests of triangles, incomplete.
  std::size_t max_tests = std::numeric_limits<std::size_t>::max();
  /// The sweep of a part ends, incomplete, soon after it has examined this many node pairs.
  std::size_t max_node_pairs = std::numeric_limits<std::size_t>::max();
};

/// Result of sweeping a part of a front.
struct FrontSweep {
  float min_gap = 3e38f;           ///< Lower bound of the gaps of the certified pairs during the sweep [mm].
  std::size_t triangle_tests = 0;  ///< Calls of the TrianglePairTest.
  std::size_t node_pairs = 0;      ///< Node pairs examined because they had no valid certificate.
  std::size_t blocked = 0;         ///< Triangle pairs whose verdict was not free.
  bool complete = true;            ///< Every pair was examined.
  bool cut = false;                ///< PreparedSweep::max_node_pairs was reached: not every pair was examined.
  /// Cylinders that are blocked by their bores, taken as one contact each: the motion is not free.
  std::vector<CylinderFit> fits;
};

/// Two pairs of a part that are the halves of one pair.
struct Siblings {
  FrontPair parent;          ///< The pair that they may merge into.
  std::uint32_t first = 0;   ///< Slot of the one half.
  std::uint32_t second = 0;  ///< Slot of the other.
};

/// The front of the tree of node pairs of two components (Li, Chen 1998; docs/design/0006-certificates.md). Each pair
/// has a certificate that proves it apart. A sweep checks every certificate with a dot product, separates again the
/// pairs whose certificates no longer hold, descends where boxes cannot be separated, and from time to time merges
/// siblings that their parents can replace. The front covers all pairs of triangles at all times, whatever the motion:
/// it affects the time of a sweep, never its result. Results do not depend on lanes or threads.
class CertificateFront {
 public:
  /// The pair of the roots; A moves. The trees and surfaces must outlive the front. @pre neither tree is empty
  /// @param surface_a, surface_b their surfaces of revolution; null if there are none
  /// @param threads threads of A that mate with those of B; must outlive the front
  CertificateFront(const ObbTree& a, const ObbTree& b, const RevolutionSurface* surface_a = nullptr,
                   const RevolutionSurface* surface_b = nullptr, Span<const ThreadMatch> threads = {});

  /// Number of pairs of nodes.
  std::size_t size() const;
  /// Number of parts. Parts may be swept in parallel.
  std::size_t part_count() const { return parts_.size(); }

  /// Prepares a motion for a sweep.
  PreparedSweep prepare_sweep(const PairMotion& motion) const;
  /// Merges siblings of a part, in some sweeps only. To be called before each sweep_part().
  void merge_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels);
  /// The siblings that merge_part() would try to merge first; empty in sweeps that do not merge this part.
  std::vector<Siblings> siblings_of(std::size_t part) const;
  /// As merge_part(), with the separations of the parents of siblings_of() as boxes, from a device.
  void merge_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels,
                  Span<const Siblings> siblings, Span<const NodeSeparation> separations);
  /// Sweeps one part and updates it.
  /// @param known results of a device for this sweep, evaluated after merging; null for none. The result is the same.
  FrontSweep sweep_part(std::size_t part, const PreparedSweep& sweep, const FrontKernels& kernels,
                        const TrianglePairTest& test, const PartResults* known = nullptr);
  /// Sweeps all parts and leaves the front unchanged: any number of motions may be swept in parallel.
  FrontSweep sweep_const(const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test) const;
  /// Ends the sweep once all parts are swept: splits parts that have grown large.
  /// @param free no pair was found blocked, and every pair was examined
  void end_sweep(const PreparedSweep& sweep, bool free);

  /// Swaps the moving and the stationary component. The pairs stay, their certificates are invalidated.
  void exchange_roles();
  /// Invalidates all certificates: the stationary component was moved.
  void forget();

  ///@{ For a device, which keeps copies.
  const ObbTree& tree_a() const { return *a_; }
  const ObbTree& tree_b() const { return *b_; }
  PairedTrees trees() const {
    return {{a_->nodes.data(), a_->triangles.data()}, {b_->nodes.data(), b_->triangles.data()}, b_moves_};
  }
  CertificatePart& part(std::size_t index) { return parts_[index]; }
  ///@}

 private:
  struct Item;
  struct Work;

  /// Adds the pairs of a part whose certificates do not hold as items.
  void find_failing(const CertificatePart& part, const PreparedSweep& sweep, const FrontKernels& kernels, Work& work,
                    FrontSweep& result) const;
  /// As find_failing(), from the results of a device.
  void take_failing(const CertificatePart& part, const PreparedSweep& sweep, const PartResults& known, Work& work,
                    FrontSweep& result) const;
  /// True if the pair is still separated by threads, by what was found when its certificate was made.
  bool still_apart(const CertificatePart& part, std::uint32_t slot, const PreparedSweep& sweep,
                   FrontSweep& result) const;
  static void add_item(const CertificatePart& part, std::uint32_t slot, Work& work);
  /// True if a part merges in this sweep.
  bool merge_due(std::size_t part) const;
  std::vector<Siblings> find_siblings(const CertificatePart& part) const;
  std::vector<NodeSeparation> separate_parents(Span<const Siblings> siblings, const PreparedSweep& sweep,
                                               const FrontKernels& kernels) const;
  /// Replaces siblings by their parents where these are separated. @return the number of pairs removed
  std::size_t merge(CertificatePart& part, const PreparedSweep& sweep, Span<const Siblings> siblings,
                    Span<const NodeSeparation> separations) const;
  /// Finds certificates for the items, descending where needed.
  void resolve(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test,
               FrontSweep& result) const;
  /// The items to start with, the first one last. Pairs that were separated radially and no longer are get split into
  /// some pairs spread over them, of which the nearest are examined first.
  std::vector<std::uint32_t> find_starts(Work& work, const PreparedSweep& sweep, FrontSweep& result) const;
  void resolve_batch(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels, const TrianglePairTest& test,
                     FrontSweep& result) const;
  void separate_boxes(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const;
  void separate_triangles(Work& work, const PreparedSweep& sweep, const FrontKernels& kernels) const;
  /// The certificate of two nodes that are separated as surfaces of revolution or as threads; it is not that of a
  /// plane.
  std::optional<Certificate> separate_radially(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep,
                                               FrontSweep& result) const;
  /// Prefetches the memory that separated_radially() needs for items list[k + ...], which is scattered over the trees.
  void prefetch_radial(const Work& work, const std::vector<std::uint32_t>& list, std::size_t k,
                       const PreparedSweep& sweep) const;
  /// The largest radial gap of two nodes over all pairs of axes [mm].
  double radial_gap(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const;
  /// The two nodes as a cylinder in a bore, if the sweep wants fits and they are one.
  std::optional<CylinderFit> fit(std::uint32_t a, std::uint32_t b, const PreparedSweep& sweep) const;
  /// Stores the certificate of a separation that certifies the item. @return false if it does not
  static bool accept(Work& work, std::uint32_t i, const NodeSeparation& separation, const LinearSweep& sweep,
                     FrontSweep& result);
  void test_triangles(Work& work, std::uint32_t i, Vec3f hint, const TrianglePairTest& test, FrontSweep& result) const;
  /// Replaces an item by the halves of its larger node, and appends their indices to a list.
  void split(Work& work, std::uint32_t i, std::vector<std::uint32_t>& halves) const;
  /// Writes the resolved items back to the part. Pairs that were separated radially stay whole in a sweep that is not
  /// free: the next sweep is another motion.
  static void replace(CertificatePart& part, const Work& work, bool free);
  /// Replaces all pairs below pairs of large nodes that are separated radially by these.
  void merge_radial(const PreparedSweep& sweep);
  /// Splits the part into two of about the same size, keeping siblings together. @return the second
  CertificatePart split_part(CertificatePart& part) const;

  const ObbTree* a_;
  const ObbTree* b_;
  const RevolutionSurface* surface_a_;
  const RevolutionSurface* surface_b_;
  Span<const ThreadMatch> threads_;
  std::vector<CertificatePart> parts_;
  std::size_t sweeps_ = 0;
  std::size_t blocked_ = 0;  ///< Sweeps that were not free since merge_radial().
  bool b_moves_ = false;
};

}  // namespace dismantle
