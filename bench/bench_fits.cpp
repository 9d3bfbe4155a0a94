// SPDX-License-Identifier: Apache-2.0
// Close fits taken apart by a trembling hand, at several clearances and tolerances: method `certificates`, response
// `slide`, every path audited.
//   bench_fits [--seeds N] [peg|key|dovetail|press|plate|corner|gears|thread...]
// One row a fit, clearance, tolerance and seed, tab-separated. straight_steps: the steps of a straight pull of 0.5 mm a
// step (gears: 0.2 mm and a rotation of 0.002 rad a step; threads, from the data folder: 4.5 degrees a step for half a
// turn). out_steps: the steps until the component was out; 0 if it was not out after twice as many as the straight
// ones. good: out_steps is at most 1.2 times straight_steps (required where tolerance and clearance together are at
// least 0.005 mm), and the audit holds. Exit code 1 where a row is not good.
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/loading/load_assembly.h"
#include "tests/support/slide_drags.h"

#include <cstdio>
#include <filesystem>
#include <functional>

namespace dismantle {
namespace {

using namespace scenes;

struct Settings {
  int seeds = 1;
  std::vector<std::string> fits;
};

struct Fit {
  std::string name, detail;
  double clearance = 0, tolerance = 0;  // [mm]
  SlideScene scene;
  int straight_steps = 0;
  std::function<Pose(int step)> steady;  // the target of a step without the trembling
};

/// Prints a row. @return good
bool run(const Fit& fit, std::uint64_t seed) {
  Hand::Options options;
  options.seed = seed;
  Hand hand(fit.scene, options);
  std::vector<Pose> targets;
  for (int k = 1; k <= 2 * fit.straight_steps; ++k) targets.push_back(hand.trembling(fit.steady(k)));
  const Drag made = drag(fit.scene, fit.tolerance, targets);
  const int out = steps_until_out(fit.scene, made);
  double initial_depth = 0, allowed_depth = fit.tolerance;
  for (const AuditPair& pair : made.audit.pairs)
    if (pair.allowed > allowed_depth) initial_depth = pair.initial_depth, allowed_depth = pair.allowed;
  std::vector<double> us;
  for (const PlayedStep& s : made.played.steps)
    if (out == 0 || static_cast<int>(us.size()) < out) us.push_back(1e3 * s.result.cost.ms);
  const bool required = fit.tolerance + fit.clearance >= 0.005 - 1e-12;
  const bool in_time = out > 0 && out <= static_cast<int>(1.2 * fit.straight_steps);
  const bool good = made.audit.holds() && (in_time || !required);
  std::printf("%s\t%s\t%g\t%g\t%llu\t%d\t%d\t%.3f\t%.5f\t%.5f\t%s\t%.0f\t%.0f\t%.0f\t%s\n", fit.name.c_str(),
              fit.detail.c_str(), 1e3 * fit.clearance, 1e3 * fit.tolerance, static_cast<unsigned long long>(seed),
              fit.straight_steps, out, distance_moved(fit.scene, made.played.steps.back().result.pose), initial_depth,
              allowed_depth, made.audit.holds() ? "holds" : "BROKEN", bench::quantile(us, 0.5),
              bench::quantile(us, 0.99), bench::quantile(us, 1), good ? "yes" : "NO");
  std::fflush(stdout);
  if (!made.audit.holds()) std::fprintf(stderr, "  %s\n", violations_of(made.audit).c_str());
  return good;
}

/// Adds half a turn of a nut on a bolt with real threads, from the data folder. @param lift moves the nut along the
/// bolt to where it is clear of the threads [mm]
void add_thread(std::vector<Fit>& fits, const std::string& assembly, double pitch, double lift, double tolerance) {
  const std::string parts = std::string(DISMANTLE_SOURCE_DIR "/../shared/data/assemblies/") + assembly + "/parts";
  if (!std::filesystem::exists(parts)) return;
  Fit fit{"thread", assembly, 0, tolerance, {}, 40, {}};
  fit.scene.assembly = load_assembly(parts).value();
  fit.scene.assembly.components[1].assembly_from_mesh.translation.z += lift;
  fit.scene.moving = ComponentId(1);
  fit.scene.pull = {0, 0, 1};
  fit.scene.exit_distance = 0.98 * pitch / 2;
  fit.scene.center = assembled_bounds(fit.scene.assembly[fit.scene.moving]).center();
  fit.steady = [pitch](int k) { return Pose{{0, 0, pitch * k / 80}, quat_about({0, 0, 1}, kTurn * k / 80)}; };
  fits.push_back(std::move(fit));
}

std::vector<Fit> make_fits(const std::string& name, double tolerance) {
  std::vector<Fit> fits;
  const auto add = [&](const std::string& detail, double clearance, SlideScene scene) {
    const double step = Hand::Options{}.step;
    const Vec3 pull = scene.pull;
    const int straight_steps = static_cast<int>(std::ceil(scene.exit_distance / step));
    fits.push_back({name, detail, clearance, tolerance, std::move(scene), straight_steps, [step, pull](int k) {
                      return Pose{k * step * pull, {}};
                    }});
  };
  for (const double clearance : {0.0, 0.001, 0.01, 0.05}) {
    if (name == "peg")
      for (const std::uint32_t sides : {24u, 64u, 256u})
        add(std::to_string(sides) + " sides", clearance, peg_in_hole(sides, clearance));
    if (name == "key") {
      add("upwards", clearance, key_in_slot(clearance, {0, 1, 0}));
      add("along", clearance, key_in_slot(clearance, {0, 0, 1}));
    }
    if (name == "dovetail") add("along", clearance, dovetail(clearance));
  }
  // The audit allows a press fit its own depth and the tolerance: only the tolerance is left to move in.
  if (name == "press") add("0.02 mm too thick", 0, press_fit_pin(64, 0.02));
  if (name == "plate") add("0.0009 mm too thick", 0, plate_in_slot(0.0009));
  if (name == "corner") add("three planes", 0, part_in_corner());
  if (name == "gears") {
    const GearPair pair = gear_pair(0.05);
    fits.push_back({name, "30 and 20 teeth", 0.05, tolerance, meshing_gears(pair), 25,
                    [pair](int k) { return pair.rolled(0.002 * k, 0.2 * k); }});
  }
  if (name == "thread") {
    add_thread(fits, "factory_nut_bolt_m8_loose", 1.25, 0.9 * 1.25, tolerance);
    add_thread(fits, "factory_nut_bolt_m16", 2, 0, tolerance);
  }
  return fits;
}

bool parse(int argc, char** argv, Settings& settings) {
  const std::vector<std::string> all = {"peg", "key", "dovetail", "press", "plate", "corner", "gears", "thread"};
  bench::CommandLine line("bench_fits [--seeds N] [peg|key|dovetail|press|plate|corner|gears|thread...]");
  line.option("--seeds", settings.seeds, 1);
  line.words(settings.fits, all);
  if (!line.parse(argc, argv)) return false;
  if (settings.fits.empty()) settings.fits = all;
  return true;
}

}  // namespace
}  // namespace dismantle

int main(int argc, char** argv) {
  using namespace dismantle;
  Settings settings;
  if (!parse(argc, argv, settings)) return bench::kExitUsage;
  std::printf(
      "fit\tdetail\tclearance_um\ttolerance_um\tseed\tstraight_steps\tout_steps\ttravel_mm\tinitial_depth_mm\tallowed_"
      "depth_mm\t"
      "audit\tmedian_us\tp99_us\tmax_us\tgood\n");
  bool good = true;
  for (const std::string& name : settings.fits)
    for (const double tolerance : {0.001, 0.005, 0.01})
      for (const Fit& fit : make_fits(name, tolerance))
        for (int seed = 1; seed <= settings.seeds; ++seed) good = run(fit, static_cast<std::uint64_t>(seed)) && good;
  return good ? 0 : bench::kExitFailed;
}
