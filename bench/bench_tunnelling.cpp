// SPDX-License-Identifier: Apache-2.0
// Single steps at, past and through thin walls whose exact time of contact is known: the verdicts of method
// `certificates` and of FCL's two continuous tests, from the identity and from start poses, near the origin and far
// from it.
//   bench_tunnelling
// Two tables, tab-separated: one row a step, distance from the origin and kind of start pose; then, after an empty
// line, one row a method with the number of its verdicts of each kind.
#include "dismantle/certificates/certificate_engine.h"
#include "tests/support/random_scenes.h"
#include "tests/support/tunnelling_scenes.h"
#ifdef DISMANTLE_WITH_FCL
#include "bench/fcl_baseline.h"
#endif

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace dismantle {
namespace {

constexpr double kTolerance = 1e-4;  // of method `certificates`: a tenth of the thinnest wall [mm]
constexpr double kRight = 0.01;      // how far from the exact contact a right verdict may stop [mm]

/// Result of a continuous test: free, or the time of the stop.
struct StepTest {
  bool free = true;
  double toi = 1;
};

struct Method {
  std::string name;
  std::function<StepTest(const scenes::OneStep&)> test;
};

StepTest certificates_test(const scenes::OneStep& step) {
  const Assembly assembly = scenes::assembly_of(step);
  CertificateEngine engine(assembly, PairStates{kTolerance, {}});
  const Pose poses[] = {Pose{}, step.start};
  engine.jump({poses, 2});
  const ComponentId moving(1);
  engine.grab({&moving, 1});
  const FirstContact first = engine.first_contact(step.target);
  return {first.free, first.toi};
}

std::vector<Method> methods() {
  std::vector<Method> all{{"certificates", certificates_test}};
#ifdef DISMANTLE_WITH_FCL
  const auto fcl = [](FclSolver solver) {
    return [solver](const scenes::OneStep& step) {
      const FclMotionResult result = continuous_fcl(step.fixed, step.moving, step.start, step.target, solver);
      return StepTest{result.free, result.toi};
    };
  };
  all.push_back({"fcl naive", fcl(FclSolver::Naive)});
  all.push_back({"fcl conservative advancement", fcl(FclSolver::ConservativeAdvancement)});
#endif
  return all;
}

/// The largest distance between a vertex at one time and the same vertex at another [mm].
double distance_between(const scenes::OneStep& step, double from, double to) {
  const RigidTransform a = transform_from_pose(pose_between(step.start, step.target, from));
  const RigidTransform b = transform_from_pose(pose_between(step.start, step.target, to));
  double distance = 0;
  for (const Vec3& p : step.moving.vertices) distance = std::max(distance, length(a * p - b * p));
  return distance;
}

enum Verdict : std::size_t {
  Right,              ///< Free and found free, or stopped within kRight of the exact contact.
  Missed,             ///< Found free though it is not.
  Late,               ///< Stopped beyond the contact.
  Early,              ///< Stopped before the contact.
  StoppedAtStart,     ///< Stopped at once, free or not.
  StoppedThoughFree,  ///< Stopped later though it is free.
  kVerdictCount
};

constexpr const char* kVerdictNames[kVerdictCount] = {"right", "missed",           "late",
                                                      "early", "stopped_at_start", "stopped_though_free"};

Verdict verdict(const scenes::OneStep& step, const StepTest& result) {
  if (step.free && result.free) return Right;
  if (step.free) return result.toi <= 0 ? StoppedAtStart : StoppedThoughFree;
  if (result.free) return Missed;
  if (distance_between(step, step.toi, result.toi) <= kRight) return Right;
  if (result.toi > step.toi) return Late;
  return result.toi <= 0 ? StoppedAtStart : Early;
}

void run() {
  const std::vector<Method> all = methods();
  std::vector<std::array<int, kVerdictCount>> counts(all.size());
  std::printf("step\torigin_distance_mm\tstart\texact_toi");
  for (const Method& method : all) std::printf("\t%s", method.name.c_str());
  std::printf("\n");
  std::mt19937_64 random(20261122);
  for (const double offset : {0.0, 1e3, 1e4, 1e5})
    for (const scenes::OneStep& suite : scenes::tunnelling_suite())
      for (const bool from_pose : {false, true}) {
        const Pose world_from_suite{{offset, -0.5 * offset, 0.25 * offset}, {}};
        scenes::OneStep step = scenes::placed(suite, world_from_suite);
        if (from_pose) step = scenes::started_from(step, scenes::random_pose(random, 20, 3));
        std::printf("%s\t%g\t%s\t%s", step.name.c_str(), offset, from_pose ? "a pose" : "identity",
                    step.free ? "free" : std::to_string(step.toi).c_str());
        for (std::size_t m = 0; m < all.size(); ++m) {
          const Verdict found = verdict(step, all[m].test(step));
          std::printf("\t%s", kVerdictNames[found]);
          ++counts[m][found];
        }
        std::printf("\n");
        std::fflush(stdout);
      }
  std::printf("\nmethod");
  for (const char* name : kVerdictNames) std::printf("\t%s", name);
  std::printf("\n");
  for (std::size_t m = 0; m < all.size(); ++m) {
    std::printf("%s", all[m].name.c_str());
    for (const int count : counts[m]) std::printf("\t%d", count);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace dismantle

int main() {
  dismantle::run();
  return 0;
}
