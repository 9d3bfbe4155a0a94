// SPDX-License-Identifier: Apache-2.0
// One step at, past and through thin walls, of which the exact time of contact is known: what our continuous test says,
// and what FCL's two say, from the identity and from start poses, near the origin and far from it.
//   bench_tunnelling
// A row a step and distance from the origin, tab-separated, then how many of each verdict a test has. A verdict is
// right where the step is free and is found free, or is stopped within 0.01 mm of the exact contact; else it is missed,
// late (beyond the contact), early (before it), at the start (stopped at once), or free though it was none.
#include "dismantle/collision/certificate_engine.h"
#include "tests/support/random_scenes.h"
#include "tests/support/tunnelling_scenes.h"
#ifdef DISMANTLE_WITH_FCL
#include "bench/fcl_baseline.h"
#endif

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dismantle {
namespace {

constexpr double kTolerance = 1e-4;  // of our test: a tenth of the thinnest wall [mm]
constexpr double kRight = 0.01;      // how far from the exact contact a right answer may be [mm]

/// What a test says of a step: whether it is free, and else when it stops.
struct Answer {
  bool free = true;
  double toi = 1;
};

struct Method {
  std::string name;
  std::function<Answer(const scenes::OneStep&)> ask;
};

Answer ours(const scenes::OneStep& step) {
  const Assembly assembly = scenes::assembly_of(step);
  CertificateEngine engine(assembly, PairStates{kTolerance, {}});
  const Pose poses[] = {Pose{}, step.start};
  engine.jump({poses, 2});
  const ComponentId moving(1);
  engine.hold({&moving, 1});
  const FirstContact first = engine.first_contacts({&step.target, 1})[0];
  return {first.free, first.toi};
}

std::vector<Method> methods() {
  std::vector<Method> all{{"ours", ours}};
#ifdef DISMANTLE_WITH_FCL
  const auto fcl = [](FclSolver solver) {
    return [solver](const scenes::OneStep& step) {
      const FirstTouch touch = continuous_fcl(step.fixed, step.moving, step.start, step.target, solver);
      return Answer{touch.free, touch.toi};
    };
  };
  all.push_back({"fcl naive", fcl(FclSolver::Naive)});
  all.push_back({"fcl conservative advancement", fcl(FclSolver::ConservativeAdvancement)});
#endif
  return all;
}

/// How far the furthest corner goes from one time to another, straight [mm].
double distance_between(const scenes::OneStep& step, double from, double to) {
  const RigidTransform a = transform_from_pose(pose_between(step.start, step.target, from));
  const RigidTransform b = transform_from_pose(pose_between(step.start, step.target, to));
  double most = 0;
  for (const Vec3& p : step.moving.vertices) most = std::max(most, length(a * p - b * p));
  return most;
}

std::string verdict(const scenes::OneStep& step, const Answer& answer) {
  if (step.free) return answer.free ? "right" : answer.toi <= 0 ? "stopped at the start" : "stopped";
  if (answer.free) return "missed";
  if (distance_between(step, step.toi, answer.toi) <= kRight) return "right";
  if (answer.toi > step.toi) return "late";
  return answer.toi <= 0 ? "stopped at the start" : "early";
}

void run() {
  const std::vector<Method> tests = methods();
  std::vector<std::map<std::string, int>> counts(tests.size());
  std::printf("step\tfrom the origin [mm]\tstart\texact");
  for (const Method& method : tests) std::printf("\t%s", method.name.c_str());
  std::printf("\n");
  std::mt19937_64 random(20261122);
  for (const double offset : {0.0, 1e3, 1e4, 1e5})
    for (const scenes::OneStep& suite : scenes::tunnelling_suite())
      for (const bool baked : {false, true}) {
        const Pose place{{offset, -0.5 * offset, 0.25 * offset}, {}};
        scenes::OneStep step = scenes::placed(suite, place);
        if (baked) step = scenes::started_from(step, scenes::random_pose(random, 20, 3));
        std::printf("%s\t%g\t%s\t%s", step.name.c_str(), offset, baked ? "a pose" : "identity",
                    step.free ? "free" : std::to_string(step.toi).c_str());
        for (std::size_t m = 0; m < tests.size(); ++m) {
          const std::string found = verdict(step, tests[m].ask(step));
          std::printf("\t%s", found.c_str());
          ++counts[m][found];
        }
        std::printf("\n");
        std::fflush(stdout);
      }
  for (std::size_t m = 0; m < tests.size(); ++m) {
    std::printf("%s:", tests[m].name.c_str());
    for (const auto& [found, count] : counts[m]) std::printf(" %d %s;", count, found.c_str());
    std::printf("\n");
  }
}

}  // namespace
}  // namespace dismantle

int main() {
  dismantle::run();
  return 0;
}
