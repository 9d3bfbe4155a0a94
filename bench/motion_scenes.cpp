// SPDX-License-Identifier: Apache-2.0
#include "bench/motion_scenes.h"

#include "bench/assembly_input.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/large_scenes.h"

#include <algorithm>
#include <functional>

namespace dismantle {

namespace {

constexpr double kTolerance = 0.01;  // of the generated scenes [mm]

/// A triangle wave: 0, 1, ... `period`, and back to 0.
int to_and_fro(int step, int period) {
  const int phase = step % (2 * period);
  return phase <= period ? phase : 2 * period - phase;
}

BenchScene generated(const std::string& name, scenes::SlideScene scene, int steps,
                     const std::function<Pose(int step)>& target) {
  BenchScene bench;
  bench.name = name;
  BenchMove move{{scene.moving}, {}};
  for (int k = 0; k <= steps; ++k) move.targets.push_back(target(k));
  bench.assembly = std::move(scene.assembly);
  bench.states.tolerance = kTolerance;
  bench.moves.push_back(std::move(move));
  return bench;
}

/// The target of a step: forward by 0.1 mm a step, to and fro across by a tenth of `clearance`, turning a little.
Pose sliding(int step, double clearance) {
  const double across = 0.1 * clearance * ((step * 7) % 5 - 2) / 2;
  return {{across, 0.5 * across, 0.1 * to_and_fro(step, 200)}, quat_about({0, 0, 1}, 1e-4 * ((step * 3) % 5 - 2))};
}

BenchScene shaft(const std::string& name, const BenchSize& size, double clearance) {
  BenchScene bench = generated(name, scenes::shaft_in_hole(size.triangles, clearance), size.steps,
                               [clearance](int k) { return sliding(k, clearance); });
  if (clearance > 0) return bench;
  ComponentPair touching;
  touching.a = ComponentId(0);
  touching.b = ComponentId(1);
  touching.state = PairState::Contact;
  touching.allowed_depth = kTolerance;
  bench.states.pairs.push_back(touching);
  return bench;
}

/// A shaft that fills its hole, moved by a trembling hand.
BenchScene shaft_touching(const std::string& name, const BenchSize& size) {
  BenchScene bench = shaft(name, size, 0);
  const scenes::SlideScene hand_scene = scenes::shaft_in_hole(1000, 0);
  scenes::Hand hand(hand_scene, {0.1, 0.3, 0.06, 1});
  for (int k = 0; k <= size.steps; ++k) {
    const Pose steady = hand.steady(0.1 * to_and_fro(k, 200));
    bench.moves[0].targets[static_cast<std::size_t>(k)] = k == 0 ? steady : hand.trembling(steady);
  }
  return bench;
}

BenchScene bolt_nut(const std::string& name, const BenchSize& size) {
  return generated(name, scenes::bolt_in_nut(size.triangles, 0.05), size.steps, [](int k) {
    return scenes::unscrewed(to_and_fro(k, 600) * kTurn / 200);  // 1.8 degrees a step
  });
}

BenchScene gears(const std::string& name, const BenchSize& size) {
  const scenes::GearPair pair = scenes::large_gear_pair(size.triangles, 0.1);
  return generated(name, scenes::meshing_gears(pair), size.steps,
                   [pair](int k) { return pair.rolled(0.01 * to_and_fro(k, 300)); });
}

BenchScene ring_torus(const std::string& name, const BenchSize& size) {
  return generated(name, scenes::ring_on_torus(size.triangles, 0.05), size.steps, [](int k) {
    return Pose{{}, quat_about({0, 0, 1}, k * kTurn / 720)};
  });
}

BenchScene sliver_peg(const std::string& name, const BenchSize& size) {
  return generated(name, scenes::sliver_peg(size.triangles, 0.05), size.steps, [](int k) { return sliding(k, 0.05); });
}

Result<BenchScene> sample(const std::string& name, const std::string& folder, bool moving) {
  BenchScene bench;
  bench.name = name;
  const Result<AssemblyFile> input = read_sample_input(folder, name);
  if (!input) return input.error();
  bench.assembly = input->assembly;
  if (!moving) return bench;
  ClassifyOptions options;
  options.executor = Executor(ExecutorKind::Threads);
  const Result<PairStates> states = classify_pairs(bench.assembly, options);
  if (!states) return states.error();
  bench.states = *states;
  if (!input->motion)
    return Error{ErrorKind::Unreadable,
                 name + " has no motion (there is none in the file or beside it); write it with --motion"};
  for (const MotionMove& recorded : input->motion->moves) {
    BenchMove move;
    for (const std::string& component : recorded.components)
      if (const std::optional<ComponentId> id = bench.assembly.find(component)) move.components.push_back(*id);
    for (const Frame& target : recorded.targets) move.targets.push_back(target.pose);
    bench.moves.push_back(std::move(move));
  }
  return bench;
}

/// The first point of a fixed sequence at which a box of that half size overlaps no triangle's box.
Vec3 free_point(const Assembly& assembly, double half) {
  std::vector<Aabb> boxes;
  for (const Component& c : assembly.components) {
    const TriangleMesh mesh = assembled_mesh(c);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      Aabb box;
      for (int k = 0; k < 3; ++k) box.extend(mesh.triangle(f)[k]);
      boxes.push_back(box);
    }
  }
  const Aabb all = inflated(assembled_bounds(assembly), -half);
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 offset = scenes::random_vector(random, 0.5), size = all.size();
    const Vec3 point = all.center() + Vec3{offset.x * size.x, offset.y * size.y, offset.z * size.z};
    const Aabb box = inflated(Aabb{point, point}, half);
    if (std::none_of(boxes.begin(), boxes.end(), [&](const Aabb& b) { return overlaps(b, box); })) return point;
  }
  return all.upper + Vec3{half, half, half};
}

/// A small trembling cube inside the lathe that touches nothing.
Result<BenchScene> loose_in_lathe(const std::string& name, const BenchSize& size, const std::string& folder) {
  Result<BenchScene> made = sample("lathe", folder, false);
  if (!made) return made;
  BenchScene& bench = *made;
  bench.name = name;
  const double half = 2;
  const Vec3 center = free_point(bench.assembly, 3 * half), h{half, half, half};
  const auto id = ComponentId(static_cast<std::uint32_t>(bench.assembly.components.size()));
  bench.assembly.components.push_back(scenes::component("loose", scenes::box(center - h, center + h)));
  bench.states.tolerance = kTolerance;
  std::mt19937_64 random(2);
  BenchMove move{{id}, {}};
  for (int k = 0; k <= size.steps; ++k) {
    const Pose shake = scenes::random_pose(random, 0.3, 0.06);
    move.targets.push_back(Pose{center, {}} * shake * Pose{-center, {}});
  }
  bench.moves.push_back(std::move(move));
  return made;
}

}  // namespace

std::vector<std::string> bench_scene_names() {
  return {"shaft_100um", "shaft_20um", "shaft_touching", "bolt_nut", "gears",
          "ring_torus",  "sliver_peg", "loose_in_lathe", "samples"};
}

Result<std::vector<BenchScene>> make_bench_scenes(const std::string& name, const BenchSize& size,
                                                  const std::string& samples_folder) {
  std::vector<BenchScene> made;
  if (name == "shaft_100um") made.push_back(shaft(name, size, 0.1));
  if (name == "shaft_20um") made.push_back(shaft(name, size, 0.02));
  if (name == "shaft_touching") made.push_back(shaft_touching(name, size));
  if (name == "bolt_nut") made.push_back(bolt_nut(name, size));
  if (name == "gears") made.push_back(gears(name, size));
  if (name == "ring_torus") made.push_back(ring_torus(name, size));
  if (name == "sliver_peg") made.push_back(sliver_peg(name, size));
  if (name == "loose_in_lathe") {
    Result<BenchScene> scene = loose_in_lathe(name, size, samples_folder);
    if (!scene) return scene.error();
    made.push_back(std::move(*scene));
  }
  for (const char* file : {"microscope", "tooling", "lathe", "robot"}) {
    if (name == "samples" || name == file) {
      Result<BenchScene> scene = sample(file, samples_folder, true);
      if (!scene) return scene.error();
      made.push_back(std::move(*scene));
    }
  }
  if (made.empty())
    return Error{ErrorKind::Usage,
                 "there is no scene '" + name + "' (it is not in the list); see the usage for their names"};
  return made;
}

}  // namespace dismantle
