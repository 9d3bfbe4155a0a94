// SPDX-License-Identifier: Apache-2.0
#include "dismantle/planner/step_maker.h"

#include <algorithm>
#include <utility>

namespace dismantle {

namespace {

/// A long way is made in parts, short ones while things are close to each other.
constexpr double kParts[] = {0.004, 0.02, 0.06, 0.12, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1};
/// A way that was stopped goes on if a new start makes at least this share of the tolerance.
constexpr double kNewStartShare = 0.1;
constexpr int kMostStarts = 8;

}  // namespace

StepMaker::StepMaker(const Assembly& assembly, const PairStates& pairs, const CertificateOptions& options, double far,
                     GoOn go_on)
    : assembly_(assembly),
      pairs_(pairs),
      options_(options),
      far_(far),
      go_on_(std::move(go_on)),
      engine_(assembly, pairs, options),
      poses_(assembly.components.size()) {}

void StepMaker::stand(const ComponentSet& present) {
  for (std::uint32_t c = 0; c < poses_.size(); ++c)
    poses_[c] = present.has(ComponentId(c)) ? Pose{} : Pose{{far_, 0, 0}, {}};
  engine_.jump(poses_);
}

StepMaker::Trial StepMaker::try_straight(Span<const ComponentId> set, const Vec3& direction, double way) {
  engine_.hold(set);
  held_ = set[0];
  const std::vector<ComponentPair> embedded = engine_.embedded_pairs();
  StepResult made;
  for (const double part : kParts) {
    made = go_on_() ? go_straight(direction, part * way) : StepResult();
    if (!made.reached) break;
  }
  Trial trial{made.reached, {}};
  const auto moves = [&](ComponentId c) { return std::find(set.begin(), set.end(), c) != set.end(); };
  const auto add = [&](ComponentId a, ComponentId b) {
    if (moves(a) != moves(b)) trial.against.emplace_back(moves(a) ? a : b, moves(a) ? b : a);
  };
  for (const CollisionContact& c : made.contacts) add(c.a, c.b);
  if (!trial.free && engine_.embedded_pairs().size() != embedded.size()) {
    // What has parted and meets again, by a rule that names no faces.
    if (trial.against.empty())
      for (const ComponentPair& pair : embedded) add(pair.a, pair.b);
    // It would be taken for parted where it stands in the other again.
    engine_ = CertificateEngine(assembly_, pairs_, options_);
  }
  std::sort(trial.against.begin(), trial.against.end());
  trial.against.erase(std::unique(trial.against.begin(), trial.against.end()), trial.against.end());
  engine_.jump(poses_);
  return trial;
}

StepResult StepMaker::go_straight(const Vec3& direction, double way) {
  const Pose target{way * direction, {}};
  for (int starts = 1;; ++starts) {
    const double before = dot(engine_.poses()[held_.value].position, direction);
    StepResult made = engine_.step(target, ResponseKind::Touch);
    // Where one start stops, a new one may go on: see straight_contact.
    const double progress = dot(made.pose.position, direction) - before;
    if (made.reached || starts == kMostStarts || !go_on_() || progress < kNewStartShare * pairs_.tolerance) return made;
  }
}

const CertificateEngine& StepMaker::hold(ComponentId component) {
  engine_.hold({&component, 1});
  return engine_;
}

}  // namespace dismantle
