// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/search/motion_validator.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// A long motion is made in parts, short ones while components are close to each other.
constexpr double kParts[] = {0.004, 0.02, 0.06, 0.12, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1};
/// A motion that was stopped goes on if a restart advances by at least this share of the tolerance.
constexpr double kNewStartShare = 0.1;
constexpr int kMaxStarts = 8;
/// Cost of a sweep in triangle-pair tests, that of a point or piece whose depth is bounded, and the number of front
/// pairs that count as one more.
constexpr std::size_t kSweepEffort = 32, kDepthEffort = 4, kFrontShare = 128;

}  // namespace

MotionValidator::MotionValidator(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options,
                                 const RigidGroups& groups, double far, KeepGoing keep_going)
    : tolerance_(pairs.tolerance),
      groups_(groups),
      far_(far),
      keep_going_(std::move(keep_going)),
      engine_(assembly, pairs, options),
      poses_(assembly.components.size()) {}

void MotionValidator::stand(const ComponentSet& present) {
  for (std::uint32_t c = 0; c < poses_.size(); ++c)
    poses_[c] = present.has(ComponentId(c)) ? Pose{} : Pose{{far_, 0, 0}, {}};
  engine_.jump(poses_);
}

MotionValidator::Trial MotionValidator::try_straight(Span<const ComponentId> set, const Vec3& direction, double way) {
  engine_.grab(set);
  moving_ = set[0];
  Trial trial = trial_of(go_straight(direction, way), set);
  put_back();
  return trial;
}

MotionValidator::Trial MotionValidator::trial_of(const StepResult& made, Span<const ComponentId> set) {
  Trial trial{made.reached, {}};
  const auto moves = [&](ComponentId c) { return std::find(set.begin(), set.end(), c) != set.end(); };
  const auto add = [&](ComponentId a, ComponentId b) {
    if (moves(a) != moves(b)) trial.against.emplace_back(moves(a) ? a : b, moves(a) ? b : a);
  };
  for (const BlockingPair& c : made.blocking_pairs) add(c.a, c.b);
  std::sort(trial.against.begin(), trial.against.end());
  trial.against.erase(std::unique(trial.against.begin(), trial.against.end()), trial.against.end());
  return trial;
}

void MotionValidator::put_back() {
  engine_.jump(poses_);
}

StepResult MotionValidator::step(const Pose& target, ResponseKind response) {
  StepResult made = engine_.step(target, response);
  effort_ += made.cost.tests + kDepthEffort * made.cost.depth_tests +
             (kSweepEffort + made.cost.pairs / kFrontShare) * static_cast<std::size_t>(made.sweeps);
  return made;
}

StepResult MotionValidator::go_straight(const Vec3& direction, double way) {
  const Pose from = pose();
  StepResult made;
  for (const double part : kParts) {
    if (!keep_going_()) return {};
    made = go_part({from.position + part * way * direction, from.rotation}, direction);
    if (!made.reached) break;
  }
  return made;
}

StepResult MotionValidator::go_part(const Pose& target, const Vec3& direction) {
  for (int starts = 1;; ++starts) {
    const Vec3 before = pose().position;
    StepResult made = step(target, ResponseKind::Touch);
    if (made.reached || starts == kMaxStarts || !keep_going_()) return made;
    // A restart may go on where a sweep stopped: see straight_contact.
    const double progress = dot(made.pose.position - before, direction);
    if (!made.unfinished && progress < kNewStartShare * tolerance_) return made;
  }
}

const CertificateEngine& MotionValidator::hold(ComponentId component) {
  engine_.grab({&component, 1});
  return engine_;
}

Clearance MotionValidator::clearance_at(Span<const ComponentId> set, const Pose& pose, double limit) {
  std::vector<Pose> poses = poses_;
  for (const ComponentId c : set) poses[c.value] = pose;
  engine_.jump(poses);
  engine_.grab(set);
  return engine_.clearance(limit);
}

void MotionValidator::take(ComponentId component) {
  engine_.grab(groups_.of(component));
  moving_ = component;
}

void MotionValidator::go_back(const Pose& pose) {
  std::vector<Pose> poses = poses_;
  for (const ComponentId c : groups_.of(moving_)) poses[c.value] = pose;
  engine_.jump(poses);
  engine_.grab(groups_.of(moving_));
}

MotionValidator::Trial MotionValidator::try_exit(const Vec3& direction, double way) {
  const Pose from = pose();
  Trial trial = trial_of(go_straight(direction, way), groups_.of(moving_));
  go_back(from);
  return trial;
}

std::vector<Vec3> MotionValidator::likely_exits(Span<const Vec3> directions, double way) {
  std::vector<Vec3> open(directions.begin(), directions.end());
  // Sweeping the first part alone is cheap and decides most cases.
  for (const double part : {kParts[0], 1.0}) {
    std::vector<Vec3> ways, free;
    for (const Vec3& d : open) ways.push_back(part * way * d);
    const std::vector<FirstContact> found = engine_.straight_contacts(ways);
    effort_ += kSweepEffort * ways.size();
    for (std::size_t i = 0; i < open.size(); ++i)
      if (found[i].free) free.push_back(open[i]);
    open = std::move(free);
  }
  return open;
}

}  // namespace dismantle
