// SPDX-License-Identifier: Apache-2.0
#include "apps/server/command_arguments.h"
#include "apps/server/workbench.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/text_name.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace dismantle::server {

namespace {

/// A reply without members, or the error.
Result<Json> empty_reply(const Result<Done>& done) {
  if (!done) return done.error();
  return Json::object();
}

Json clearance_json(const Clearance& c) {
  if (!std::isfinite(c.distance)) return {{"distance", nullptr}};
  return {{"distance", c.distance},
          {"moving", c.moving.value},
          {"fixed", c.fixed.value},
          {"point_moving", to_json(c.point_moving)},
          {"point_fixed", to_json(c.point_fixed)}};
}

}  // namespace

/// The commands of docs/wire.md: a function of the same name for each.
class WorkbenchCommands {
 public:
  WorkbenchCommands(Workbench& bench, const Json& command)
      : bench_(bench), session_(bench.session()), in_(command, session_.assembly().components.size()) {}

  Result<Json> hold() {
    const auto components = in_.components();
    return components ? bench_.grab(*components) : components.error();
  }
  Result<Json> release() {
    session_.release();
    bench_.drop_input();
    return Json::object();
  }
  Result<Json> cancel_drag() {
    session_.cancel_drag();
    bench_.drop_input();
    return Json::object();
  }
  Result<Json> set_response() {
    const auto response = in_.response();
    if (!response) return response.error();
    if (!session_.can_respond(*response))
      return usage("this response cannot be chosen",
                   "method " + session_.drag_engine().method + " has no " + std::string(name_of(*response)),
                   "choose touch or stop");
    session_.set_response(*response);
    return Json::object();
  }
  Result<Json> undo() {
    bench_.drop_input();
    return empty_reply(session_.undo());
  }
  Result<Json> redo() {
    bench_.drop_input();
    return empty_reply(session_.redo());
  }
  Result<Json> take_out() {
    const auto components = in_.components();
    if (!components) return components.error();
    const auto direction = in_.direction();
    if (!direction) return direction.error();
    return start_motion(session_.take_out(*components, *direction));
  }
  Result<Json> put_back() {
    const auto components = in_.components();
    return components ? start_motion(session_.put_back(*components)) : components.error();
  }
  Result<Json> halt() {
    session_.halt();
    return Json::object();
  }
  Result<Json> free_directions() {
    const auto components = in_.components();
    if (!components) return components.error();
    const auto found = session_.free_directions(*components);
    if (!found) return found.error();
    Json list = Json::array();
    for (const FreeDirection& d : *found)
      list.push_back({{"direction", to_json(d.direction)},
                      {"free", d.free},
                      {"distance", d.distance},
                      {"blocked_by", d.free ? Json(nullptr) : Json(d.blocked_by.value)}});
    return Json{{"directions", std::move(list)}};
  }
  Result<Json> plan() {
    const auto targets = in_.list("targets");
    if (!targets) return targets.error();
    const auto fixed = in_.list("fixed");
    if (!fixed) return fixed.error();
    const auto preferences = in_.preferences();
    if (!preferences) return preferences.error();
    const auto effort = in_.effort();
    if (!effort) return effort.error();
    return bench_.search({SearchKind::Plan, {}, *targets, *fixed, *preferences, {}, *effort});
  }
  Result<Json> find_path() {
    const auto components = in_.components();
    return components ? bench_.search({SearchKind::TakeOut, {}, *components, {}, {}, {}}) : components.error();
  }
  Result<Json> why() {
    const auto components = in_.components();
    if (!components) return components.error();
    if (components->size() > 1)
      return usage("the blockers cannot be determined", "several components are selected", "select one");
    return bench_.search({SearchKind::Why, {}, *components, {}, {}, {}});
  }
  Result<Json> instructions() {
    Result<InstructionsRequest> request = instructions_request(in_.command(), *bench_.model());
    if (!request) return request.error();
    const Result<std::uint32_t> job = bench_.start_instructions_(std::move(*request));
    if (!job) return job.error();
    return Json{{"job", *job}};
  }
  Result<Json> play() {
    const auto source = in_.source();
    if (!source) return source.error();
    const auto speed = in_.number("speed");
    return speed ? start_motion(session_.play(*source, *speed)) : speed.error();
  }
  Result<Json> pause() {
    session_.pause();
    return Json::object();
  }
  Result<Json> seek() {
    auto source = in_.source();
    if (!source) return source.error();
    if (const Playback* open = session_.playback()) source = open->source();
    const auto time = in_.number("time");
    return time ? start_motion(session_.seek(*source, *time)) : time.error();
  }
  Result<Json> stop() {
    session_.stop_playback();
    return Json::object();
  }
  Result<Json> close_guide() {
    session_.close_guide();
    return Json::object();
  }
  Result<Json> resume() {
    const Result<RestoredSession> resumed = bench_.journals_.resume(session_);
    if (!resumed) return resumed.error();
    bench_.is_resumed_ = true;
    if (!resumed->warning.empty()) bench_.warn(resumed->warning);
    return Json::object();
  }
  Result<Json> open_path() {
    const auto file = find_file(&Roots::find);
    if (!file) return file.error();
    return empty_reply(bench_.open_guide(*file, file->filename().string()));
  }
  Result<Json> save() {
    const auto file = find_file(&Roots::output_path);
    if (!file) return file.error();
    const std::string name = file->filename().string(), suffix = ".path.json";
    if (name.size() <= suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
      return usage("the recording cannot be saved", "the file name must end in .path.json", "choose another name");
    const std::string text = *bench_.recording_text();
    const Result<Done> written = write_file(*file, text);
    if (!written) return written.error();
    return Json{{"bytes", text.size()}};
  }
  Result<Json> hide() { return change_visibility(&Visibility::hide); }
  Result<Json> show() { return change_visibility(&Visibility::show); }
  Result<Json> isolate() { return change_visibility(&Visibility::isolate); }
  Result<Json> restore() {
    session_.visibility().restore();
    return Json::object();
  }
  Result<Json> reset() {
    session_.reset();
    bench_.drop_input();
    return Json::object();
  }
  Result<Json> check() { return clashes_json(bench_.model()->clashes); }
  /// The engine's metrics; the hub adds those of the network.
  Result<Json> metrics() {
    StepStatistics& s = bench_.statistics_;
    const auto quantiles = [](const RecentValues& values) {
      return Json{{"median", values.quantile(0.5)}, {"p99", values.quantile(0.99)}, {"max", values.quantile(1)}};
    };
    return Json{{"steps", s.steps()},
                {"steps_per_second", s.steps_per_second(Workbench::Clock::now())},
                {"step_us", quantiles(s.step_us())},
                {"hand_to_pose_us", quantiles(s.latency_us())},
                {"front_size", session_.engine().front_size()},
                {"device", device_of_drags()}};
  }
  /// The CPU took over where a GPU failed.
  std::string device_of_drags() const {
    const DragEngine& used = session_.drag_engine();
    return used.failure && !used.failure->why.empty() ? "cpu (the GPU failed: " + used.failure->why + ")" : used.device;
  }
  Result<Json> clearance() {
    if (session_.moving().empty())
      return usage("there is no clearance", "no component is being dragged", "drag a component first");
    return clearance_json(session_.engine().clearance());
  }

 private:
  Result<Json> change_visibility(void (Visibility::*change)(Span<const ComponentId>)) {
    const auto components = in_.components();
    if (!components) return components.error();
    (session_.visibility().*change)(*components);
    return Json::object();
  }

  /// Starts an automatic motion.
  Result<Json> start_motion(const Result<Done>& started) {
    bench_.drop_input();
    bench_.stepped_at_ = Workbench::Clock::now();
    return empty_reply(started);
  }

  Result<std::filesystem::path> find_file(Result<std::filesystem::path> (Roots::*find)(std::uint64_t,
                                                                                       const std::string&) const) {
    const auto root = in_.index("root");
    if (!root) return root.error();
    const auto file = in_.text("file");
    return file ? (bench_.roots_.*find)(*root, *file) : file.error();
  }

  Workbench& bench_;
  Session& session_;
  Arguments in_;
};

namespace {

struct CommandEntry {
  std::string_view name;
  bool changes_session;
  Result<Json> (WorkbenchCommands::*execute)();
};

constexpr std::array kCommands = {
    CommandEntry{"hold", true, &WorkbenchCommands::hold},
    CommandEntry{"release", true, &WorkbenchCommands::release},
    CommandEntry{"cancel_drag", true, &WorkbenchCommands::cancel_drag},
    CommandEntry{"set_response", true, &WorkbenchCommands::set_response},
    CommandEntry{"undo", true, &WorkbenchCommands::undo},
    CommandEntry{"redo", true, &WorkbenchCommands::redo},
    CommandEntry{"take_out", true, &WorkbenchCommands::take_out},
    CommandEntry{"put_back", true, &WorkbenchCommands::put_back},
    CommandEntry{"halt", true, &WorkbenchCommands::halt},
    CommandEntry{"free_directions", false, &WorkbenchCommands::free_directions},
    CommandEntry{"plan", true, &WorkbenchCommands::plan},
    CommandEntry{"find_path", true, &WorkbenchCommands::find_path},
    CommandEntry{"why", true, &WorkbenchCommands::why},
    CommandEntry{"instructions", true, &WorkbenchCommands::instructions},
    CommandEntry{"play", true, &WorkbenchCommands::play},
    CommandEntry{"pause", true, &WorkbenchCommands::pause},
    CommandEntry{"seek", true, &WorkbenchCommands::seek},
    CommandEntry{"stop", true, &WorkbenchCommands::stop},
    CommandEntry{"close_guide", true, &WorkbenchCommands::close_guide},
    CommandEntry{"resume", true, &WorkbenchCommands::resume},
    CommandEntry{"open_path", true, &WorkbenchCommands::open_path},
    CommandEntry{"save", true, &WorkbenchCommands::save},
    CommandEntry{"hide", true, &WorkbenchCommands::hide},
    CommandEntry{"show", true, &WorkbenchCommands::show},
    CommandEntry{"isolate", true, &WorkbenchCommands::isolate},
    CommandEntry{"restore", true, &WorkbenchCommands::restore},
    CommandEntry{"reset", true, &WorkbenchCommands::reset},
    CommandEntry{"check", false, &WorkbenchCommands::check},
    CommandEntry{"clearance", false, &WorkbenchCommands::clearance},
    CommandEntry{"metrics", false, &WorkbenchCommands::metrics},
};

const CommandEntry* find_command(std::string_view name) {
  for (const CommandEntry& entry : kCommands)
    if (entry.name == name) return &entry;
  return nullptr;
}

}  // namespace

bool Workbench::needs_control(std::string_view command) {
  const CommandEntry* entry = find_command(command);
  return entry == nullptr || entry->changes_session;
}

Result<Json> Workbench::execute(const Json& command) {
  const std::string name = command.value("command", "");
  const CommandEntry* entry = find_command(name);
  if (entry == nullptr)
    return usage("the command was not understood", "there is no command " + in_quotes(name), "see docs/wire.md");
  if (!model_) return usage("'" + name + "' cannot be done", "no assembly is open", "open one first");
  WorkbenchCommands commands(*this, command);
  Result<Json> result = (commands.*entry->execute)();
  changed_ |= entry->changes_session;
  return result;
}

}  // namespace dismantle::server
