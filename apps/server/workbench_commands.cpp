// SPDX-License-Identifier: Apache-2.0
#include "apps/server/workbench.h"

#include <array>
#include <cmath>
#include <string>

namespace dismantle::server {

namespace {

Error usage(const std::string& problem, const std::string& why, const std::string& advice) {
  return {ErrorKind::Usage, problem + " (" + why + "); " + advice};
}

/// The members of a command. What is missing or of a wrong kind is an error that names it.
class Arguments {
 public:
  Arguments(const Json& command, std::size_t component_count) : command_(command), component_count_(component_count) {}

  Result<std::vector<ComponentId>> components() const {
    const auto found = command_.find("components");
    if (found == command_.end() || !found->is_array() || found->empty())
      return wrong("components", "a list of indices");
    std::vector<ComponentId> ids;
    for (const Json& one : *found) {
      if (!one.is_number_unsigned() || one.get<std::uint64_t>() >= component_count_)
        return wrong("components", "indices of components of the assembly");
      ids.emplace_back(one.get<std::uint32_t>());
    }
    return ids;
  }

  Result<ResponseKind> response() const {
    const auto found = command_.find("response");
    for (const ResponseKind kind : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide})
      if (found != command_.end() && *found == std::string(name_of(kind))) return kind;
    return wrong("response", "one of slide, touch, stop");
  }

 private:
  static Error wrong(const std::string& member, const std::string& wanted) {
    return usage("the command was not understood", "'" + member + "' must be " + wanted, "look at docs/wire.md");
  }

  const Json& command_;
  std::size_t component_count_;
};

Result<Json> answer(const Result<Done>& done) {
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

/// The commands of docs/wire.md, a function each.
class WorkbenchCommands {
 public:
  WorkbenchCommands(Workbench& bench, const Json& command)
      : bench_(bench), session_(bench.session()), in_(command, session_.assembly().components.size()) {}

  Result<Json> hold() {
    const auto components = in_.components();
    return components ? bench_.hold(*components) : components.error();
  }
  Result<Json> release() {
    session_.release();
    bench_.drop_targets();
    return Json::object();
  }
  Result<Json> cancel_drag() {
    session_.cancel_drag();
    bench_.drop_targets();
    return Json::object();
  }
  Result<Json> set_response() {
    const auto response = in_.response();
    if (!response) return response.error();
    session_.set_response(*response);
    return Json::object();
  }
  Result<Json> undo() {
    bench_.drop_targets();
    return answer(session_.undo());
  }
  Result<Json> redo() {
    bench_.drop_targets();
    return answer(session_.redo());
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
    bench_.drop_targets();
    return Json::object();
  }
  Result<Json> check() { return pairs_json(session_.pairs()); }
  /// Of the engine; the hub adds what the network counts.
  Result<Json> metrics() {
    StepStatistics& s = bench_.statistics_;
    const auto quantiles = [](const RecentValues& values) {
      return Json{{"median", values.quantile(0.5)}, {"p99", values.quantile(0.99)}, {"max", values.quantile(1)}};
    };
    return Json{{"steps", s.steps()},
                {"steps_per_second", s.steps_per_second(Workbench::Clock::now())},
                {"step_us", quantiles(s.step_us())},
                {"hand_to_pose_us", quantiles(s.hand_to_pose_us())},
                {"front_size", session_.engine().front_size()},
                {"device", "cpu"}};
  }
  Result<Json> clearance() {
    if (session_.moving().empty())
      return usage("there is no clearance to tell", "nothing is in hand", "take a component in hand first");
    return clearance_json(session_.engine().clearance());
  }

 private:
  Result<Json> change_visibility(void (Visibility::*change)(Span<const ComponentId>)) {
    const auto components = in_.components();
    if (!components) return components.error();
    (session_.visibility().*change)(*components);
    return Json::object();
  }

  Workbench& bench_;
  Session& session_;
  Arguments in_;
};

namespace {

struct CommandEntry {
  std::string_view name;
  bool is_question;
  Result<Json> (WorkbenchCommands::*run)();
};

constexpr std::array kCommands = {
    CommandEntry{"hold", false, &WorkbenchCommands::hold},
    CommandEntry{"release", false, &WorkbenchCommands::release},
    CommandEntry{"cancel_drag", false, &WorkbenchCommands::cancel_drag},
    CommandEntry{"set_response", false, &WorkbenchCommands::set_response},
    CommandEntry{"undo", false, &WorkbenchCommands::undo},
    CommandEntry{"redo", false, &WorkbenchCommands::redo},
    CommandEntry{"hide", false, &WorkbenchCommands::hide},
    CommandEntry{"show", false, &WorkbenchCommands::show},
    CommandEntry{"isolate", false, &WorkbenchCommands::isolate},
    CommandEntry{"restore", false, &WorkbenchCommands::restore},
    CommandEntry{"reset", false, &WorkbenchCommands::reset},
    CommandEntry{"check", true, &WorkbenchCommands::check},
    CommandEntry{"clearance", true, &WorkbenchCommands::clearance},
    CommandEntry{"metrics", true, &WorkbenchCommands::metrics},
};

const CommandEntry* find_command(std::string_view name) {
  for (const CommandEntry& entry : kCommands)
    if (entry.name == name) return &entry;
  return nullptr;
}

}  // namespace

bool Workbench::is_question(std::string_view command) {
  const CommandEntry* entry = find_command(command);
  return entry != nullptr && entry->is_question;
}

Result<Json> Workbench::execute(const Json& command) {
  const std::string name = command.value("command", "");
  const CommandEntry* entry = find_command(name);
  if (entry == nullptr)
    return usage("the command was not understood", "there is none called '" + name + "'", "look at docs/wire.md");
  if (!model_) return usage("'" + name + "' cannot be done", "no assembly is open", "open one first");
  WorkbenchCommands commands(*this, command);
  Result<Json> result = (commands.*entry->run)();
  changed_ |= !entry->is_question;
  return result;
}

}  // namespace dismantle::server
