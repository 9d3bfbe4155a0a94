// SPDX-License-Identifier: Apache-2.0
#include "bench/soak/batch.h"

#include "bench/timing.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/session/step_limit.h"
#include "tests/support/random_scenes.h"

#include <algorithm>
#include <cmath>

namespace dismantle::soak {

namespace {

/// A motion counts as free where it needs no more than this share of the tolerance: ghost surfaces leave 0.62 of the
/// tolerance where two faces touch, and the audit knows depths to a fifth of what it allows. The engine must make
/// kStuckProgress of it.
constexpr double kStuckAllowance = 0.5, kStuckProgress = 0.9;
/// Steps that a free straight motion may take, of which all but the last end early.
constexpr int kStuckSteps = 300;
/// Width of a bin of times, as a factor.
constexpr double kBin = 1.05;

/// Targets of one drag: a steady pull of a random component from its assembled pose in a random direction, trembling.
MotionMove random_drag(std::mt19937_64& random, const Assembly& assembly, int targets) {
  const auto index = static_cast<std::size_t>(random() % assembly.components.size());
  const Component& component = assembly.components[index];
  const Aabb box = assembled_bounds(component);
  const double size = diagonal(box);
  const double shake = std::min(0.3, 0.02 * size);
  Vec3 direction = normalized(scenes::random_vector(random, 1) + Vec3{0, 0, 1e-9});
  if (random() % 2 == 0) {  // along an axis, as most fits are
    Vec3 axis;
    axis[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1 : -1;
    direction = axis;
  }
  const double length = size * std::uniform_real_distribution<double>(0.05, 1.5)(random);
  MotionMove move{{component.name}, {}};
  for (int k = 1; k <= targets; ++k) {
    const Pose center{box.center() + (length * k / targets) * direction, {}};
    const Pose target = center * scenes::random_pose(random, shake, 0.06) * Pose{-box.center(), {}};
    move.targets.push_back({0.01 * k, target});
  }
  return move;
}

/// An engine whose steps are timed.
class TimedEngine final : public MotionEngine {
 public:
  TimedEngine(MotionEngine& engine, bench::ClockNs now) : engine_(engine), now_(now) {}

  void grab(Span<const ComponentId> components) override { engine_.grab(components); }
  Span<const ComponentId> moving_set() const override { return engine_.moving_set(); }
  StepResult step(const Pose& target, ResponseKind response) override {
    const bench::Stopwatch watch(now_);
    StepResult result = engine_.step(target, response);
    times_us_.push_back(watch.us());
    return result;
  }
  bool can_respond(ResponseKind response) const override { return engine_.can_respond(response); }
  void jump(Span<const Pose> poses) override { engine_.jump(poses); }
  Span<const Pose> poses() const override { return engine_.poses(); }
  std::vector<ComponentPair> overlapping_pairs() const override { return engine_.overlapping_pairs(); }

  const std::vector<double>& times_us() const { return times_us_; }

 private:
  MotionEngine& engine_;
  bench::ClockNs now_;
  std::vector<double> times_us_;  // of each step
};

/// The moving component and what is within `reach` of it, as they are at these poses, as an assembled state.
Assembly surroundings(const Assembly& assembly, Span<const Pose> poses, ComponentId moving, double reach) {
  const auto placed = [&](std::size_t c) {
    Component component = assembly.components[c];
    component.assembly_from_mesh = transform_from_pose(poses[c]) * component.assembly_from_mesh;
    return component;
  };
  const Aabb near = inflated(assembled_bounds(placed(moving.value)), reach);
  Assembly now = assembly;
  now.components.clear();
  for (std::size_t c = 0; c < assembly.components.size(); ++c) {
    Component component = placed(c);
    if (overlaps(assembled_bounds(component), near)) now.components.push_back(std::move(component));
  }
  return now;
}

/// A path of these components without moves, with kStuckAllowance of the tolerance for all pairs. What overlaps more is
/// not tested: where surfaces are allowed to overlap depends on the place, not only on the pair.
Path strict_path(const Assembly& now, const PairStates& states) {
  Path path;
  for (const Component& c : now.components) path.components.push_back(c.name);
  path.tolerance = kStuckAllowance * states.tolerance;
  return path;
}

/// True if an audit accepts a straight motion of a component that overlaps nothing by more than the path's tolerance.
bool straight_is_free(const Assembly& now, const PathAuditor& auditor, Path path, const std::string& moving,
                      Vec3 displacement) {
  path.moves.push_back({"straight", {moving}, {{0, {}}, {1, {displacement, {}}}}});
  const AuditReport report = auditor.audit(path);
  const ComponentId id = *now.find(moving);
  const auto is_of_moving = [&](const auto& pair) { return pair.a == id || pair.b == id; };
  return std::none_of(report.violations.begin(), report.violations.end(), is_of_moving) &&
         std::none_of(report.pairs.begin(), report.pairs.end(), is_of_moving);
}

/// Tests whether the component that was moved last is stuck, by short straight motions.
void test_for_stuck(const Assembly& assembly, const PairStates& states, ComponentId moving, CertificateEngine& engine,
                    BatchResult& result) {
  const std::vector<Pose> poses(engine.poses().begin(), engine.poses().end());
  const double distance = std::min(0.5, 0.05 * diagonal(assembled_bounds(assembly[moving])));
  // A pose's position is that of the origin: a small rotation moves it far where the component is far from it.
  const Vec3 center = assembled_bounds(assembly[moving]).center();
  const Assembly now = surroundings(assembly, poses, moving, distance + 2 * states.tolerance);
  const PathAuditor auditor(now);
  const Path strict = strict_path(now, states);
  for (int k = 0; k < 6; ++k) {
    Vec3 displacement;
    displacement[k / 2] = k % 2 == 0 ? distance : -distance;
    if (!straight_is_free(now, auditor, strict, assembly[moving].name, displacement)) continue;
    engine.jump(poses);
    engine.grab({&moving, 1});
    ++result.straight_motions;
    const Pose& pose = poses[moving.value];
    const Pose target{pose.position + displacement, pose.rotation};
    double made = 0;
    StepResult last;
    // A step may end early (limit_steps); the next goes on.
    for (int step = 0; step < kStuckSteps && made < kStuckProgress && (step == 0 || last.unfinished); ++step) {
      last = engine.step(target, ResponseKind::Slide);
      const Vec3 way = transform_from_pose(last.pose) * center - transform_from_pose(pose) * center;
      made = dot(way, displacement) / (distance * distance);
    }
    if (made < kStuckProgress) ++result.stuck;
  }
}

}  // namespace

int TimeHistogram::bin_of(double us) {
  return static_cast<int>(std::floor(std::log(std::max(us, 1e-3)) / std::log(kBin)));
}

void TimeHistogram::add(const TimeHistogram& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
}

double TimeHistogram::quantile(double q) const {
  std::size_t total = 0, below = 0;
  for (const auto& [bin, count] : bins_) total += count;
  for (const auto& [bin, count] : bins_) {
    below += count;
    if (static_cast<double>(below) >= q * static_cast<double>(total)) return std::pow(kBin, bin + 0.5);
  }
  return 0;
}

void BatchResult::add(const BatchResult& other) {
  batches += other.batches;
  steps += other.steps;
  reached += other.reached;
  violations += other.violations;
  audits_cut += other.audits_cut;
  straight_motions += other.straight_motions;
  stuck += other.stuck;
  front = std::max(front, other.front);
  longest_us = std::max(longest_us, other.longest_us);
  times.add(other.times);
  engine_seconds += other.engine_seconds;
  audit_seconds += other.audit_seconds;
  if (message.empty()) message = other.message;
}

Batch run_batch(const Assembly& assembly, const PairStates& states, std::shared_ptr<const AssemblySurfaces> surfaces,
                const PathAuditor& auditor, std::uint64_t seed, const BatchOptions& options) {
  std::mt19937_64 random(seed);
  Batch batch;
  BatchResult& result = batch.result;
  result.batches = 1;
  batch.motion.response = ResponseKind::Slide;
  for (int k = 0; k < kDragsPerBatch; ++k) batch.motion.moves.push_back(random_drag(random, assembly, options.targets));

  const bench::Stopwatch engine_watch;
  CertificateOptions engine_options;
  limit_steps(engine_options);
  engine_options.prepared = std::move(surfaces);
  if (options.threads > 1) engine_options.executor = Executor(ExecutorKind::Threads, options.threads);
  CertificateEngine engine(assembly, states, engine_options);
  TimedEngine timed(engine, options.threads > 1 ? bench::wall_ns : bench::thread_ns);
  Result<PlayedMotion> played = play_motion(assembly, states, batch.motion, timed);
  result.engine_seconds = engine_watch.seconds();
  for (const double us : timed.times_us()) {
    result.times.add(us);
    result.longest_us = std::max(result.longest_us, us);
  }
  for (const PlayedStep& step : played->steps) {
    result.reached += step.result.reached ? 1 : 0;
    result.front = std::max(result.front, step.result.cost.pairs);
  }
  result.steps = played->steps.size();
  batch.path = std::move(played->path);

  const bench::Stopwatch audit_watch;
  AuditOptions audit_options;
  audit_options.progress = [&](std::string_view, double) { return audit_watch.seconds() < options.audit_seconds; };
  const AuditReport report = auditor.audit(batch.path, audit_options);
  result.audits_cut = report.complete ? 0 : 1;
  result.violations = report.violations.size();
  if (!report.violations.empty()) result.message = report.violations.front().message;
  const ComponentId last = *assembly.find(batch.motion.moves.back().components.front());
  test_for_stuck(assembly, states, last, engine, result);
  result.audit_seconds = audit_watch.seconds();
  return batch;
}

}  // namespace dismantle::soak
