// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/certificates/sweep/triangle_pair_sweep.h"
#include "dismantle/engine/pair_rules.h"

#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dismantle {

/// Two triangles of which a sweep found that they would get too deep in each other.
struct BlockedPair {
  ComponentId moving, fixed;
  FaceId face_moving, face_fixed;
  double toi = 0;  ///< The motion is certainly allowed for them on [0, toi].
  Vec3
      axis;  ///< Unit, from the moving to the fixed one [assembled frame of the fixed one]; zero where none parts them.
};

/// A cylinder that its bore holds back, of the set in hand and something else.
struct BlockedFit {
  ComponentId moving, fixed;
  CylinderFit fit;
};

/// What a sweep of the set in hand found.
struct CertificateSweep {
  double toi = 1;
  bool free = true;
  /// False where blocked pairs were left out: `toi` may then be too late, and `blocked` lacks some. Free is always
  /// complete.
  bool complete = true;
  std::vector<BlockedPair> blocked;  ///< Those within the window of the first; by components and faces.
  std::vector<BlockedFit> fits;      ///< With Effort::Fits: what was not looked into any further.
  double clearance = 0;              ///< No pair came nearer than this during the sweep [mm]; 0 where not free.
  std::size_t front = 0;             ///< Node pairs of the fronts looked at.
  std::size_t leaf_tests = 0;
  std::size_t answered_tests = 0;  ///< Those of them that a device answered.
  /// Moving and fixed: pairs of components of which not everything was certainly apart all the time.
  std::vector<std::pair<ComponentId, ComponentId>> touching;
};

/// How hard a sweep tries. Less is never unsafe, and faster: a motion along contacts is cut up anyway.
enum class Effort {
  Full,   ///< Each triangle pair until nothing is gained any more; all that are blocked.
  Some,   ///< The same for some that are blocked, from all over.
  Quick,  ///< Some, each in a few steps, none smaller than what matters.
  Fits,   ///< The same, but cylinders that their bores hold back are told whole.
};

/// One component's way straight past another, from where they are.
struct StraightWay {
  ComponentId moving, fixed;
  Vec3 way;  ///< [mm]
  Pose moving_at, fixed_at;
};

/// The fronts of certificates between the set in hand and everything else, and sweeps along screws
/// (docs/design/0006-certificates.md). Knows the poses of all components. Embedded pairs are not its business.
class CertificateSweeper {
 public:
  CertificateSweeper(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                     CertificateDevice device = {});

  void hold(Span<const ComponentId> components);
  Span<const ComponentId> held() const { return held_; }
  bool holds(ComponentId c) const { return is_held_[c.value]; }
  /// The pose of the set in hand.
  const Pose& pose() const { return poses_[held_.front().value]; }

  /// The motion of the set in hand by the one screw from its pose to `end`. Nothing moves.
  /// @param window how long after the first contact others are reported, as a part of the motion
  /// @param effort how hard a triangle pair is tried before it counts as blocked
  /// @pre deviation(end) is less than the tolerance; beyond kArcShare of it what is allowed may be found blocked
  CertificateSweep sweep(const Pose& end, double window, Effort effort = Effort::Full);
  /// As sweep() for a motion from `start`, leaving the fronts as they are: any number may be looked at side by side.
  CertificateSweep look(const Pose& start, const Pose& end, double window) const;
  /// Part of a component's way straight past another: whether it is free, and else some contacts, not the first of all.
  /// Nothing of what is in hand or was moved matters. Free while the two are embedded.
  /// @param from, to shares of the way
  CertificateSweep look_straight(const StraightWay& asked, double from, double to) const;
  /// The triangle pairs that are nearer than `reach` [mm] where the set in hand is, and perhaps some more.
  std::vector<BlockedPair> near_pairs(double reach) const;
  /// The same motion of one pair of triangles, with Effort::Quick: whether it is blocked, and by which axis.
  /// @param pair with the axis to begin with
  TrianglePairResult sweep_pair(const BlockedPair& pair, const Pose& end) const;
  /// The same motion of these pairs alone, with Effort::Full; those of the same components one after the other.
  CertificateSweep sweep_pairs(Span<const BlockedPair> pairs, const Pose& end, double window) const;
  /// An upper bound of the distance between arcs and chords of the whole motion [mm].
  double deviation(const Pose& end) const { return deviation(pose(), end); }
  /// An upper bound of how far any point of the set goes [mm].
  double travel(const Pose& end) const { return travel(pose(), end); }

  /// Puts the set in hand at `pose`.
  void move_to(const Pose& pose);
  void jump(Span<const Pose> poses);
  Span<const Pose> poses() const { return poses_; }

  double tolerance() const { return rules_.tolerance(); }
  /// How deep triangles of the two may be in each other; negative where they are embedded.
  double allowed(ComponentId a, ComponentId b) const;
  /// They touched or overlapped in the assembled state.
  bool touched(ComponentId a, ComponentId b) const;
  /// The pair is not embedded any more.
  void part(ComponentId a, ComponentId b) { rules_.part(std::min(a, b), std::max(a, b)); }

  const SolidTree& solid(ComponentId c) const { return solids_[c.value]; }
  const Assembly& assembly() const { return *assembly_; }
  const Executor& executor() const { return options_.executor; }
  /// Center and radius of the set in hand where it is now [mm, world].
  Vec3 center() const { return transform_from_pose(pose()) * center_; }
  double radius() const { return radius_; }
  std::size_t front_size() const;

 private:
  /// Components a < b and their front.
  struct FrontEntry {
    CertificateFront front;
    bool b_moves = false;
    Pose fixed_pose;  ///< Of what stood still in the last sweep.
  };
  struct ActivePair;
  struct Look;
  struct PartTask;

  SideRule sides(ComponentId a, ComponentId b) const;
  TrianglePairSweep triangle_pair_sweep(ComponentId moving, ComponentId fixed, const Pose& start, const Pose& end,
                                        Effort effort) const;
  /// How far apart the spheres of the two certainly stay while the moving one goes from `start` to `end`, its arcs
  /// within `deviation` of their chords [mm]; below 0 where they may meet.
  double sphere_gap(ComponentId moving, ComponentId fixed, const RigidTransform& start, const RigidTransform& end,
                    double deviation) const;
  /// Calls visit(moving, fixed) for the pairs that may come nearer to each other than `reach` during a motion.
  template <class Visit>
  void for_each_near(const Pose& start, const Pose& end, double reach, CertificateSweep& result, Visit visit) const;
  /// Calls run(i) for every i below `count`, on the executor's threads where that is worth it.
  template <class Run>
  void for_each_part(std::size_t count, const Run& run) const;
  /// Whether there is a device, and enough for it to do.
  bool asks_device(const std::vector<ActivePair>& active) const;
  static std::vector<FrontQuery<TrianglePairSweep>> asked_fronts(const std::vector<ActivePair>& active);
  /// Merges what the parts that are due gather, with what the device says of it.
  void merge_by_device(const std::vector<ActivePair>& active, const std::vector<PartTask>& tasks);
  /// Adds what looking at a pair finds, from a front of theirs.
  void look_at(const CertificateFront& front, const Look& look, CertificateSweep& result) const;
  /// @param answers of a device to tests of the whole motion
  static TrianglePairTest triangle_pair_test(const ActivePair& pair, PartTask& task, double window,
                                             Span<const TrianglePairResult> answers = {});
  static void finish(CertificateSweep& result, double window);
  double deviation(const Pose& start, const Pose& end) const;
  double travel(const Pose& start, const Pose& end) const;
  /// Works out what is round of components that lie about one axis in the assembled state, and whose threads fit, so
  /// that no step has to.
  void prepare_round();
  /// The front that begins with the roots of both.
  CertificateFront roots(ComponentId a, ComponentId b, SideRule sides) const;
  FrontEntry& front_of(ComponentId moving, ComponentId fixed);

  const Assembly* assembly_;
  CertificateOptions options_;
  FrontKernels kernels_;
  PairRules rules_;
  std::vector<SolidTree> solids_;
  std::vector<Vec3> centers_;  ///< Of spheres around the assembled components.
  std::vector<double> radii_;
  std::vector<Pose> poses_;
  std::vector<ComponentId> held_;
  std::vector<bool> is_held_;
  Vec3 center_;  ///< Of a sphere around the set in hand [assembled].
  double radius_ = 0;
  std::map<std::pair<ComponentId, ComponentId>, FrontEntry> fronts_;
  std::map<std::pair<ComponentId, ComponentId>, std::vector<ThreadMatch>> threads_;  ///< Of a < b, where any fit.
  CertificateDevice device_;
};

}  // namespace dismantle
