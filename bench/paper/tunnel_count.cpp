// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/tunnel_count.h"

#include "bench/baselines/obb_discrete_engine.h"
#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/streams/streams_motion_engine.h"
#include "tests/support/random_scenes.h"

namespace dismantle {

namespace {

constexpr double kTolerance = 0.01;  // [mm]
constexpr int kStepsPerCase = 200;

/// A cube of 2 mm in front of a plate of 0.1 mm moves by 3 mm, obliquely and turning a little.
TunnelCase thin_wall() {
  TunnelCase made{"thin wall", {}};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> distance(1.2, 6);
  for (int k = 0; k < kStepsPerCase; ++k) {
    const Pose start = Pose{{0, 0, -distance(random)}, {}} * scenes::random_pose(random, 0.1, 0.1);
    const Pose motion = Pose{{0, 0, 3}, {}} * scenes::random_pose(random, 0.5, 0.2);
    scenes::OneStep step;
    step.fixed = scenes::box({-20, -20, 0}, {20, 20, 0.1});
    step.moving = scenes::moved(scenes::box({-1, -1, -1}, {1, 1, 1}), start);
    step.target = start * motion * inverse(start);
    made.steps.push_back(std::move(step));
  }
  return made;
}

/// A shaft of radius 10 mm in a housing with a wall of 10 mm moves by 60 mm along the bore or in any other direction.
TunnelCase fast_motion() {
  TunnelCase made{"fast motion", {}};
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> angle(0, 2 * std::acos(-1.0));
  for (int k = 0; k < kStepsPerCase; ++k) {
    const double azimuth = angle(random), elevation = angle(random);
    const Vec3 direction{std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                         std::sin(elevation)};
    scenes::OneStep step;
    step.fixed = scenes::tube(20, 10, 0, 40, 32, 4);
    step.moving = scenes::tube(9.9, 0, 0, 40, 32, 4);
    step.target.position = 60.0 * (k % 4 == 0 ? Vec3{0, 0, 1} : direction);
    made.steps.push_back(std::move(step));
  }
  return made;
}

/// True if the audit finds a violation on the motion of component 1 to the target.
bool collides(const Assembly& assembly, const PairStates& states, const Pose& target) {
  Path path;
  for (const Component& c : assembly.components) path.components.push_back(c.name);
  path.tolerance = states.tolerance;
  path.moves.push_back({"step", {assembly.components[1].name}, {{0, {}}, {1, target}}});
  return !audit_path(assembly, path).holds();
}

}  // namespace

std::vector<TunnelCase> tunnel_cases() {
  return {thin_wall(), fast_motion()};
}

std::vector<TunnelMethod> tunnel_methods() {
  using Engine = std::unique_ptr<MotionEngine>;
  return {{"one box a component (discrete)",
           [](const Assembly& assembly, const PairStates& states) {
             return make_obb_discrete_engine(assembly, states, ObbDetail::Boxes);
           }},
          {"boxes (discrete)",
           [](const Assembly& assembly, const PairStates& states) {
             return make_obb_discrete_engine(assembly, states, ObbDetail::Triangles);
           }},
          {"streams", [](const Assembly& assembly,
                         const PairStates& states) { return make_streams_motion_engine(assembly, states, {}); }},
          {"certificates", [](const Assembly& assembly, const PairStates& states) -> Engine {
             return std::make_unique<CertificateEngine>(assembly, states);
           }}};
}

std::vector<TunnelCount> count_tunnels(const TunnelCase& tunnel_case, const std::vector<TunnelMethod>& methods) {
  std::vector<TunnelCount> counts(methods.size());
  const PairStates states{kTolerance, {}};
  const ComponentId moving(1);
  for (const scenes::OneStep& step : tunnel_case.steps) {
    const Assembly assembly = scenes::assembly_of(step);
    const bool blocked = collides(assembly, states, step.target);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::unique_ptr<MotionEngine> engine = methods[m].make(assembly, states);
      engine->grab({&moving, 1});
      const bool reached = engine->step(step.target, ResponseKind::Stop).reached;
      TunnelCount& count = counts[m];
      ++count.steps;
      count.meeting += blocked ? 1 : 0;
      count.tunnels += blocked && reached ? 1 : 0;
      count.false_stops += !blocked && !reached ? 1 : 0;
    }
  }
  return counts;
}

}  // namespace dismantle
