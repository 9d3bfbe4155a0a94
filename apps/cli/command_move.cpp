// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/cli/part_options.h"
#include "dismantle/certificates/choose_certificate_device.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/session/play_motion.h"
#include "dismantle/streams/streams_motion_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct MoveOptions {
  CommonOptions common;
  std::string motion_file;
  std::string output;
  std::string method = "certificates";
  std::optional<ElementaryTest> test;
  std::optional<ResponseKind> response;
  std::string timing_file;
};

/// The time of a stage [ms]; empty if the method has no such stage.
std::string stage_text(const StepCost& cost, std::string_view stage) {
  for (const StageTime& time : cost.stages)
    if (time.stage == stage) return fmt::format("{:.4f}", time.ms);
  return "";
}

/// A row for each simulation step: the columns of Table 1 of the paper, and the sizes of the streams.
std::string timing_csv(const Motion& motion, const PlayedMotion& played) {
  std::string csv =
      "step,move,target,time_s,components,reached,contacts,sweeps,vertices_ms,bvh_refit_ms,front_ms,intersection_test_"
      "ms,"
      "overall_ms,front,triangle_pairs,intersection_pairs,elementary_tests,answered_tests,replays\n";
  for (std::size_t i = 0; i < played.steps.size(); ++i) {
    const PlayedStep& s = played.steps[i];
    const StepResult& r = s.result;
    csv +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{:.4f},{},{},{},{},{},{}\n", i, s.move, s.target, s.time,
                    motion.moves[s.move].components.size(), r.reached ? 1 : 0, r.blocking_pairs.size(), r.sweeps,
                    stage_text(r.cost, kVerticesStage), stage_text(r.cost, kRefitStage),
                    stage_text(r.cost, kFrontStage), stage_text(r.cost, kIntersectionStage), r.cost.ms, r.cost.pairs,
                    r.cost.triangle_pairs, r.cost.overlapping_pairs, r.cost.tests, r.cost.device_tests, r.cost.replays);
  }
  return csv;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto place = values.begin() + std::lround(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Summary of one move for the user: how far it got and which components blocked it.
struct MoveSummary {
  std::size_t steps = 0, reached = 0;
  double requested = 0;                        ///< Displacement of the center by the last target [mm].
  double travelled = 0;                        ///< Displacement of the center by the last pose [mm].
  std::map<std::string, std::size_t> blocked;  ///< Steps that each component stopped.
};

/// Center of the common box of the components in the assembled state [mm].
Vec3 center_of(const Assembly& assembly, const std::vector<std::string>& names) {
  Aabb box;
  for (const std::string& name : names)
    if (const std::optional<ComponentId> id = assembly.find(name)) box.extend(assembled_bounds(assembly[*id]));
  return box.empty() ? Vec3{} : box.center();
}

std::vector<MoveSummary> summarize(const Assembly& assembly, const Motion& motion, const PlayedMotion& played) {
  std::vector<MoveSummary> moves(played.path.moves.size());
  for (const PlayedStep& step : played.steps) {
    MoveSummary& m = moves[step.move];
    ++m.steps;
    m.reached += step.result.reached ? 1 : 0;
    std::vector<std::string> blockers;
    for (const BlockingPair& c : step.result.blocking_pairs) {
      const std::string& a = assembly[c.a].name;
      const std::vector<std::string>& own = motion.moves[step.move].components;
      blockers.push_back(std::find(own.begin(), own.end(), a) == own.end() ? a : assembly[c.b].name);
    }
    std::sort(blockers.begin(), blockers.end());
    blockers.erase(std::unique(blockers.begin(), blockers.end()), blockers.end());
    for (const std::string& name : blockers) ++m.blocked[name];
  }
  for (std::size_t m = 0; m < moves.size(); ++m) {
    const Vec3 center = center_of(assembly, motion.moves[m].components);
    const auto at = [&](const Pose& pose) { return transform_from_pose(pose) * center; };
    const Vec3 start = at(played.path.moves[m].frames.front().pose);
    if (!motion.moves[m].targets.empty()) moves[m].requested = length(at(motion.moves[m].targets.back().pose) - start);
    moves[m].travelled = length(at(played.path.moves[m].frames.back().pose) - start);
  }
  return moves;
}

std::string blockers_text(const MoveSummary& m) {
  std::string text;
  for (const auto& [name, count] : m.blocked) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, count);
  return text.empty() ? "nothing" : text;
}

/// Cost of the whole motion.
struct MoveCost {
  std::string device;
  std::vector<double> overall;  ///< Of each step [ms].
};

Json to_json(const MoveOptions& o, const Path& path, const std::vector<MoveSummary>& moves, const MoveCost& cost) {
  const std::vector<double>& overall = cost.overall;
  Json list = Json::array();
  for (std::size_t m = 0; m < moves.size(); ++m) {
    Json blocked = Json::object();
    for (const auto& [name, count] : moves[m].blocked) blocked[name] = count;
    list.push_back({{"label", path.moves[m].label},
                    {"steps", moves[m].steps},
                    {"reached", moves[m].reached},
                    {"asked_mm", moves[m].requested},
                    {"got_mm", moves[m].travelled},
                    {"blocked_by", blocked}});
  }
  return {{"format", "dismantle-move"},
          {"version", 1},
          {"path", o.output},
          {"method", o.method},
          {"device", cost.device},
          {"tolerance_mm", path.tolerance},
          {"steps", overall.size()},
          {"step_ms",
           {{"median", quantile(overall, 0.5)}, {"p99", quantile(overall, 0.99)}, {"max", quantile(overall, 1)}}},
          {"moves", list},
          {"removed", path.removed}};
}

void print_text(const MoveOptions& o, const Path& path, const std::vector<MoveSummary>& moves, const MoveCost& cost) {
  std::size_t width = 4;
  for (const Move& m : path.moves) width = std::max(width, m.label.size());
  fmt::print("{:<{}}  {:>6}  {:>7}  {:>10}  {:>10}  stopped by (steps)\n", "move", width, "steps", "reached",
             "asked mm", "got mm");
  for (std::size_t m = 0; m < moves.size(); ++m)
    fmt::print("{:<{}}  {:>6}  {:>7}  {:>10.3f}  {:>10.3f}  {}\n", path.moves[m].label, width, moves[m].steps,
               moves[m].reached, moves[m].requested, moves[m].travelled, blockers_text(moves[m]));
  fmt::print("\n{} steps, {:.3f} ms a step (median), {:.3f} ms (p99), on {}; tolerance {:.4g} mm\n",
             cost.overall.size(), quantile(cost.overall, 0.5), quantile(cost.overall, 0.99), cost.device,
             path.tolerance);
  if (!path.removed.empty()) {
    std::string names;
    for (const std::string& n : path.removed) names += (names.empty() ? "" : ", ") + n;
    fmt::print("taken out: {}\n", names);
  }
  fmt::print("wrote {}\n", o.output);
}

/// The engine of the requested method, and the name of its device.
struct MoveEngine {
  std::unique_ptr<MotionEngine> engine;
  std::string device = "cpu";
  std::shared_ptr<const DeviceFailure> failure;  ///< Null on the CPU.
};

MoveEngine make_engine(const MoveOptions& o, const Assembly& assembly, const PairStates& states) {
  const Executor executor = make_executor(o.common);
  if (o.method == "certificates") {
    ChosenCertificateDevice chosen = choose_certificate_device(o.common.device);
    if (!chosen.why.empty()) note_cpu(o.common, chosen.why);
    const CertificateOptions certificates{executor, widest_lanes()};
    return {std::make_unique<CertificateEngine>(assembly, states, certificates, std::move(chosen.use)), chosen.device,
            chosen.failure};
  }
  CollisionOptions collision;
  collision.test = o.test.value_or(ElementaryTest::Certified);
  collision.executor = executor;
  ChosenStreamsBackend chosen = choose_streams_backend(assembly, collision, o.common.device);
  if (!chosen.why.empty()) note_cpu(o.common, chosen.why);
  return {make_streams_motion_engine(assembly, states, collision, std::move(chosen.backend)), chosen.device,
          chosen.failure};
}

/// Adds the other members of its components' groups to a move. Unknown names are left for play_motion() to refuse.
void take_groups_along(MotionMove& move, const Assembly& assembly, const RigidGroups& groups) {
  std::vector<ComponentId> own;
  for (const std::string& name : move.components) {
    const std::optional<ComponentId> id = assembly.find(name);
    if (!id) return;  // refused where the motion is played
    own.push_back(*id);
  }
  for (const ComponentId c : groups.with_groups(own))
    if (std::find(own.begin(), own.end(), c) == own.end()) move.components.push_back(assembly[c].name);
}

Result<ExitCode> run(const MoveOptions& o) {
  const Result<Motion> read = read_motion(o.motion_file);
  if (!read) return read.error();
  Motion motion = *read;
  if (o.response) motion.response = *o.response;
  if (motion.response == ResponseKind::Slide && o.method == "streams")
    return Error{ErrorKind::Usage,
                 "method streams does not slide (its responses are stop and touch, as in the paper); give --response "
                 "touch or stop, or --method certificates"};

  if (o.test && o.method != "streams")
    return Error{
        ErrorKind::Usage,
        "--ccd chooses the continuous test of method streams (certificates has one of its own); leave it out, or "
        "give --method streams"};

  const Result<Assembly> assembly = load(o.common);
  if (!assembly) return assembly.error();
  Result<PairStates> states = classify(*assembly, o.common);
  if (!states) return states.error();

  const Result<PartChoices> choices = choose_parts(*assembly, *states, o.common);
  if (!choices) return choices.error();
  for (MotionMove& move : motion.moves) take_groups_along(move, *assembly, choices->groups);

  const MoveEngine moving = make_engine(o, *assembly, *states);
  const Result<PlayedMotion> played =
      play_motion(*assembly, *states, motion, *moving.engine, progress_printer(o.common));
  if (!played) return played.error();
  if (moving.failure && !moving.failure->why.empty())
    std::fprintf(stderr, "dismantle: note: the GPU failed (%s); the CPU computed the rest, with the same results\n",
                 moving.failure->why.c_str());
  if (played->cancelled) std::fprintf(stderr, "dismantle: cancelled; the path contains the motion so far\n");

  const Result<Done> written = write_path(o.output, played->path);
  if (!written) return written.error();
  if (!o.timing_file.empty()) {
    const Result<Done> timing = write_file(o.timing_file, timing_csv(motion, *played));
    if (!timing) return timing.error();
  }

  MoveCost cost{moving.device, {}};
  for (const PlayedStep& s : played->steps) cost.overall.push_back(s.result.cost.ms);
  const std::vector<MoveSummary> moves = summarize(*assembly, motion, *played);
  if (o.common.json) {
    fmt::print("{}\n", to_json(o, played->path, moves, cost).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(o, played->path, moves, cost);
  }
  return played->cancelled ? ExitCode::Failed : ExitCode::Done;
}

}  // namespace

void add_move_command(CLI::App& app, ExitCode& exit_code) {
  static const std::map<std::string, ElementaryTest> kTests{{"certified", ElementaryTest::Certified},
                                                            {"elementary", ElementaryTest::Elementary}};
  static const std::map<std::string, ResponseKind> kResponses{
      {"stop", ResponseKind::Stop}, {"touch", ResponseKind::Touch}, {"slide", ResponseKind::Slide}};
  CLI::App* command = app.add_subcommand("move", "Play a motion with collision handling and write the resulting path");
  auto options = std::make_shared<MoveOptions>();
  add_assembly_argument(*command, options->common);
  command->add_option("MOTION", options->motion_file, "Motion to play (*.motion.json)")->required();
  command->add_option("-o,--output", options->output, "Path file to write (*.path.json)")
      ->required()
      ->type_name("FILE");
  command->add_option("--method", options->method, "Collision method")
      ->type_name("certificates|streams")
      ->check(one_of({"certificates", "streams"}))
      ->capture_default_str();
  command
      ->add_option("--ccd", options->test,
                   "Continuous test of method streams: certified (no false negatives) or elementary (cubic roots, as "
                   "in the paper)")
      ->transform(choice(kTests))
      ->type_name("certified|elementary");
  command
      ->add_option("--response", options->response,
                   "Response to contact: stop before the step, touch, or slide (default: as in the motion file)")
      ->transform(choice(kResponses))
      ->type_name("stop|touch|slide");
  add_flexible_option(*command, options->common);
  add_together_option(*command, options->common);
  command->add_option("--timing", options->timing_file, "Write the cost of every step as CSV")->type_name("CSV");
  add_allow_option(*command, options->common);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    options->common.uses_device = true;
    const Result<ExitCode> result = run(*options);
    exit_code = result ? *result : report(result.error());
  });
}

}  // namespace dismantle::cli
