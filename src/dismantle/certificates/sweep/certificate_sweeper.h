// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/pair_state.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/ghosts/find_guards.h"
#include "dismantle/certificates/sweep/certificate_sweep.h"
#include "dismantle/certificates/sweep/front_store.h"
#include "dismantle/certificates/sweep/near_components.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/math/screw.h"
#include "dismantle/surface/depth/swept_depth.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dismantle {

/// Sweeps of the moving set along screws, by the fronts between its components and all others
/// (docs/design/0006-certificates.md). Each component is tested against the ghost surface of the other one. Keeps the
/// poses of all components. Pairs without ghost surfaces (PairGuard) are ignored.
class CertificateSweeper {
 public:
  /// All components in the assembled state, none grabbed.
  CertificateSweeper(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                     CertificateDevice device = {});

  /// Makes these components the moving set. @pre not empty, all at the same pose
  void grab(Span<const ComponentId> components);
  /// The components grabbed, ascending.
  Span<const ComponentId> moving_set() const { return moving_; }
  /// True if the component is in the moving set.
  bool moves(ComponentId c) const { return is_moving_[c.value]; }
  /// The pose of the moving set. @pre it is not empty
  const Pose& pose() const { return poses_[moving_.front().value]; }

  /// The motion of the moving set from its pose to `end`.
  ScrewMotion motion_to(const Pose& end) const { return motion_between(pose(), end); }
  /// The motion of the moving set from `start` to `end`.
  ScrewMotion motion_between(const Pose& start, const Pose& end) const;

  /// Sweeps the moving set along a motion from its pose, and updates the fronts. Nothing moves.
  /// @param window time after the first contact in which others are reported, as a fraction of the motion
  /// @pre the motion's deviation is at most kArcShare of the tolerance (chord_count)
  CertificateSweep sweep(const ScrewMotion& motion, double window, SweepBudget budget = SweepBudget::Exhaustive);
  /// As sweep() for a motion from any pose, leaving the fronts unchanged: any number may run in parallel.
  /// @param goal end of the whole motion that it is a part of, from the pose of the moving set
  CertificateSweep sweep_const(const ScrewMotion& motion, double window, const Pose& goal) const;
  /// Sweeps part of a translation of one component past another: reports if it is free, and else some contacts, not
  /// necessarily the first. Independent of the moving set and of all poses. Free for pairs without ghost surfaces.
  /// @param from, to the part, as fractions of the displacement @param search_for, max_pieces of first_deeper()
  CertificateSweep sweep_linear(const LinearMotion& motion, double from, double to, DeepSearch search_for,
                                std::size_t max_pieces) const;
  /// The triangle pairs that are nearer than `reach` [mm] at the present poses, and possibly some more.
  std::vector<SweepContact> near_pairs(double reach) const;
  /// The same as if a component, at its present pose, were the moving set. Any number may run in parallel.
  std::vector<SweepContact> near_pairs(ComponentId moving, double reach) const;
  /// Tests one pair of triangles along a motion from the present pose, with SweepBudget::Bounded.
  /// @param pair with the axis to start with
  TrianglePairResult sweep_pair(const SweepContact& pair, const ScrewMotion& motion) const;
  /// Tests only these pairs along a motion from the present pose, with SweepBudget::Exhaustive.
  /// @param pairs those of the same components in a row
  CertificateSweep sweep_pairs(Span<const SweepContact> pairs, const ScrewMotion& motion, double window) const;

  /// The components, ascending, that may be met by the moving set on a translation from its pose [mm], and some others.
  std::vector<ComponentId> near_straight(const Vec3& displacement) const;

  /// Puts the moving set at `pose` without a test.
  void move_to(const Pose& pose);
  /// Puts the moving set back at a pose at which it has been since the last jump; pairs that parted on the way from
  /// there overlap again if they do there.
  void return_to(const Pose& pose);
  /// Puts all components at `poses` without a test. Releases the moving set if that moves one of it.
  void jump(Span<const Pose> poses);
  /// The poses of all components.
  Span<const Pose> poses() const { return poses_; }

  /// The tolerance [mm].
  double tolerance() const { return tolerance_; }
  /// What two components may do.
  GuardedPair guarded(ComponentId a, ComponentId b) const;
  /// The pairs with an allowance of their own that have not been apart since, a < b.
  std::vector<ComponentPair> overlapping_pairs() const;
  /// Their number.
  std::size_t overlapping_count() const { return guarded_.size() - parted_count_; }
  ///@{ The surfaces of a pair.
  const SolidTree& moving_surface(const TestedPair& pair) const {
    if (pair.surfaces == SurfacePair::MovingMirrored) return store_.mirrored_ghost(pair.moving, pair.fixed);
    return pair.surfaces == SurfacePair::MovingGhost ? store_.ghost(pair.moving, pair.fixed) : solid(pair.moving);
  }
  const SolidTree& fixed_surface(const TestedPair& pair) const {
    if (pair.surfaces == SurfacePair::FixedMirrored) return store_.mirrored_ghost(pair.fixed, pair.moving);
    return pair.surfaces == SurfacePair::FixedGhost ? store_.ghost(pair.fixed, pair.moving) : solid(pair.fixed);
  }
  ///@}
  /// From now on the pair is treated like any other pair. @pre they are further apart than the tolerance
  void part(ComponentId a, ComponentId b) { change_parted(a, b, true); }
  /// Parts the pairs of the moving set that are apart at its pose.
  void part_others();

  /// Begins a step: its sweeps share CertificateOptions::depth_tests. They have no limit outside a step. Sheets that
  /// lie on each other come apart to the side to which it leads (SheetSides).
  void begin_step(const Pose& target);
  /// Takes what a sweep of the step examined from that.
  void count_work(const CertificateSweep& sweep) {
    depth_tests_left_ -= std::min(sweep.depth_tests, depth_tests_left_);
    node_pairs_left_ -= std::min(sweep.node_pairs + sweep.front / kChecksPerNodePair, node_pairs_left_);
  }
  /// True if the step has reached one of these limits.
  bool is_used_up() const { return depth_tests_left_ == 0 || node_pairs_left_ == 0; }
  /// Ends the step.
  void end_step() { depth_tests_left_ = node_pairs_left_ = kUnlimited; }

  /// The surfaces, which other engines can share.
  const std::shared_ptr<const AssemblySurfaces>& surfaces() const { return store_.surfaces(); }
  /// The tree of a component.
  const SolidTree& solid(ComponentId c) const { return store_.solid(c); }
  /// The options.
  const CertificateOptions& options() const { return options_; }
  /// Center of a sphere around the moving set at its pose [mm, world].
  Vec3 center() const { return transform_from_pose(pose()) * center_; }
  /// Radius of that sphere [mm].
  double radius() const { return radius_; }
  /// Number of node pairs of the fronts of the moving set.
  std::size_t front_size() const { return store_.size(is_moving_); }

 private:
  struct PairSweep;
  struct PartTask;

  /// The surfaces of two components that are tested: each with the ghost of the other; none without ghosts.
  Span<const SurfacePair> surface_pairs(ComponentId a, ComponentId b) const;
  /// The same for a motion that may be the first one of two sheets past each other.
  /// @param start, end of the moving component [mm, world]
  Span<const SurfacePair> surface_pairs(ComponentId moving, ComponentId fixed, const Pose& start, const Pose& end,
                                        const Pose& pose_fixed) const;
  void set_parted(ComponentId a, ComponentId b, bool parted);
  /// As set_parted(); keeps the count of pairs that have parted.
  void change_parted(ComponentId a, ComponentId b, bool parted);
  /// Notes that pairs of a component may part or overlap again: find_parted() looks at those.
  void mark_changed(ComponentId c);
  void place(ComponentId c, const Pose& pose);
  ComponentAt placed(ComponentId c);
  /// True if two components are further apart than a distance [mm], and none is inside the other.
  bool apart(ComponentId a, ComponentId b, double distance);
  bool usual_ghosts_apart(ComponentId a, ComponentId b);
  /// True if the faces that were near when last looked for are too near for the pair to have parted. Looks for others
  /// if not.
  bool near(ComponentId a, ComponentId b, GuardedPair& pair) const;
  /// Parts pairs that were apart throughout a sweep that was free.
  void part_swept(const std::vector<PairSweep>& pairs);
  /// A motion of a component with respect to another one [assembled frame of the fixed one].
  struct SeenMotion {
    ComponentId moving, fixed;
    Pose start, end;
  };
  SeenMotion motion_past(const ScrewMotion& motion, ComponentId moving, ComponentId fixed) const;
  /// The shape of a component, built when first asked for.
  const SolidShape& shape(ComponentId c) const { return *surfaces()->shape(c, options_.executor); }
  /// How the surface of the first component was found to be shallow in the second one.
  using KnownDepth = std::map<std::pair<ComponentId, ComponentId>, ShallowParts>;
  /// Adds the contact of components whose depth is bounded, if there is one up to a time. @param known may be null
  /// @param max_pieces of first_deeper(): where it gives up earlier than by itself, the result is undecided
  void sweep_depth(const SeenMotion& motion, DeepSearch search_for, CertificateSweep& result, double until = 1,
                   KnownDepth* known = nullptr, std::size_t max_pieces = kMaxSweptPieces) const;
  /// Adds the contacts of such pairs that are not later than those known by more than `window`.
  void sweep_depths(const std::vector<SeenMotion>& motions, double window, CertificateSweep& result);
  double displaced(ComponentId a, ComponentId b) const {
    return guarded(a, b).displaced + (1 - kGhostLength) * tolerance_;
  }
  /// Finds the pairs that have parted from the present poses, of components that have changed.
  void find_parted();
  /// Adds the pairs of faces of two components at rest that are nearer than `reach` [mm], and possibly some more.
  void add_near_faces(ComponentId moving, ComponentId fixed, const ScrewMotion& rest, double reach,
                      std::vector<SweepContact>& pairs) const;
  TrianglePairSweep triangle_pair_sweep(const TestedPair& pair, const ScrewMotion& motion, SweepBudget budget) const;
  /// Calls visit(moving, fixed) for the component pairs that may come nearer to each other than `reach` during a
  /// motion.
  template <class Visit>
  void for_each_near(const ScrewMotion& motion, double reach, CertificateSweep& result, Visit visit) const;
  /// Calls run(i) for every i below `count`, on the executor's threads if there is more than one.
  template <class Run>
  void for_each_part(std::size_t count, const Run& run) const;
  /// The pairs to be swept, with their fronts. @param depths gets the motions of those whose depth is to be bounded
  std::vector<PairSweep> prepare_pairs(const ScrewMotion& motion, SweepBudget budget, CertificateSweep& result,
                                       std::vector<SeenMotion>& depths);
  /// Results of the device for one sweep.
  struct DeviceResults {
    bool merged = false;            ///< It merged the parts.
    Span<const PartResults> parts;  ///< Of each part; empty if the device is not used, or has failed.
  };
  /// Merges and evaluates on the device, if it is used. A device that fails is given up.
  DeviceResults ask_device(const std::vector<PairSweep>& pairs, const std::vector<PartTask>& tasks, SweepBudget budget);
  static std::vector<FrontQuery> front_queries(const std::vector<PairSweep>& pairs);
  /// Merges the parts, with separations that the device computes.
  void merge_by_device(const std::vector<PairSweep>& pairs, const std::vector<PartTask>& tasks);
  static void collect(const std::vector<PartTask>& tasks, std::vector<PairSweep>& pairs, CertificateSweep& result);
  /// Sweeps a pair by a front that stays unchanged, and adds the result.
  void sweep_const(const CertificateFront& front, const PairSweep& pair, double window, CertificateSweep& result) const;
  static TrianglePairTest triangle_pair_test(const PairSweep& pair, PartTask& task, double window);
  static void finish(CertificateSweep& result, double window);

  CertificateOptions options_;
  FrontKernels kernels_;
  double tolerance_;
  std::map<std::pair<ComponentId, ComponentId>, GuardedPair> guarded_;  ///< Those with an allowance of their own.
  KnownDepth known_depth_;                                              ///< Since the last jump.
  FrontStore store_;
  CertificateDevice device_;
  NearComponents near_;
  std::vector<Pose> poses_;
  std::vector<ComponentId> moving_;
  std::vector<bool> is_moving_;
  std::vector<std::vector<ComponentId>> guarded_of_;  ///< The other components of its pairs in `guarded_`.
  std::size_t parted_count_ = 0;                      ///< Of the pairs in `guarded_`.
  std::vector<ComponentId> changed_;                  ///< Since find_parted() was last called.
  std::vector<bool> is_changed_;
  /// Checking this many certificates takes about as long as examining one node pair.
  static constexpr std::size_t kChecksPerNodePair = 16;
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
  ///@{ Of the present step.
  std::size_t depth_tests_left_ = kUnlimited, node_pairs_left_ = kUnlimited;
  ///@}
  Vec3 center_;  ///< Of a sphere around the moving set [mm, assembled].
  double radius_ = 0;
};

}  // namespace dismantle
