// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/documents/path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

struct AuditCommand {
  CommonOptions common;
  std::string path_file;
  std::size_t list = 10;
};

std::size_t frame_count(const Path& path) {
  std::size_t count = 0;
  for (const Move& move : path.moves) count += move.frames.size();
  return count;
}

Json to_json(const AuditViolation& v, const Assembly& a) {
  const auto name = [&a](ComponentId id) { return id.valid() ? Json(a[id].name) : Json(nullptr); };
  Json json = {
      {"kind", name_of(v.kind)}, {"move", v.move == AuditViolation::kAssembledState ? Json(nullptr) : Json(v.move)},
      {"frame", v.frame},        {"t", v.time},
      {"a", name(v.a)},          {"b", name(v.b)},
      {"message", v.message}};
  if (v.kind == AuditViolationKind::PathInconsistent) return json;
  json["of"] = name(v.point_of_a ? v.a : v.b);
  json["point"] = {v.point.x, v.point.y, v.point.z};
  json["depth_mm"] = v.depth;
  json["allowed_mm"] = v.allowed;
  json["greatest_mm"] = v.greatest;
  return json;
}

Json to_json(const AuditPair& pair, const Assembly& a) {
  const bool checked = pair.state != PathPairState::Free;
  return {{"a", a[pair.a].name},
          {"b", a[pair.b].name},
          {"state", name_of(pair.state)},
          {"checked", checked ? "always" : "once apart"},
          {"initial_depth_mm", checked ? Json(pair.initial_depth) : Json(nullptr)},
          {"allowed_mm", checked ? Json(pair.allowed) : Json(nullptr)},
          {"parted", pair.parted}};
}

Json to_json(const AuditReport& report, const Assembly& a, const Path& path) {
  Json pairs = Json::array(), violations = Json::array();
  for (const AuditPair& pair : report.pairs) pairs.push_back(to_json(pair, a));
  for (const AuditViolation& v : report.violations) violations.push_back(to_json(v, a));
  return {
      {"format", "dismantle-audit"},
      {"version", 2},
      {"assembly", {{"file", a.source_file}, {"components", a.components.size()}, {"triangles", triangle_count(a)}}},
      {"moves", path.moves.size()},
      {"frames", frame_count(path)},
      {"holds", report.holds()},
      {"unchecked_pairs", report.count(PathPairState::Free)},
      {"declared_pairs", report.count(PathPairState::Declared)},
      {"tolerance_mm", report.tolerance},
      {"slack_mm", report.slack},
      {"sheets", report.sheets},
      {"pieces", report.pieces},
      {"seconds", report.seconds},
      {"violations", violations},
      {"pairs", pairs}};
}

/// Lists the pairs in a state that is not the audit's own finding.
void print_pairs(const AuditReport& report, const Assembly& a, PathPairState state, std::size_t list) {
  const std::size_t count = report.count(state);
  if (count == 0) return;
  const char* pairs = count == 1 ? "pair" : "pairs";
  if (state == PathPairState::Free)
    fmt::print("{} {} unchecked until they have been apart:\n", count, pairs);
  else
    fmt::print("{} {} declared by the user to get deeper:\n", count, pairs);
  std::size_t printed = 0;
  for (const AuditPair& pair : report.pairs) {
    if (pair.state != state || printed == list) continue;
    ++printed;
    const std::string allowed = state == PathPairState::Free ? "" : fmt::format(", {:.4g} mm allowed", pair.allowed);
    fmt::print("  \"{}\" and \"{}\"{}{}\n", a[pair.a].name, a[pair.b].name, allowed,
               pair.parted ? ", apart since" : "");
  }
  if (count > list) fmt::print("  ... and {} more\n", count - list);
}

void print_text(const AuditReport& report, const Assembly& a, const Path& path, std::size_t list) {
  fmt::print("{} moves, {} frames; tolerance {:.4g} mm, slack {:.4g} mm; {} pieces in {:.2f} s\n", path.moves.size(),
             frame_count(path), report.tolerance, report.slack, report.pieces, report.seconds);
  if (report.sheets > 0) fmt::print("{} of {} components bound no volume\n", report.sheets, a.components.size());
  print_pairs(report, a, PathPairState::Declared, list);
  print_pairs(report, a, PathPairState::Free, list);
  const std::size_t count = report.violations.size(), unchecked = report.count(PathPairState::Free);
  if (count == 0) {
    fmt::print("the guarantee holds{}\n", unchecked > 0 ? ", except for the unchecked pairs" : "");
    return;
  }
  fmt::print("the guarantee does not hold: {} violation{}\n", count, count == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(list, count); ++i) {
    const AuditViolation& v = report.violations[i];
    const bool in_move = v.kind == AuditViolationKind::PathInconsistent && v.move != AuditViolation::kAssembledState;
    fmt::print("  {}: {}{}\n", name_of(v.kind), in_move ? fmt::format("move {}: ", v.move + 1) : "", v.message);
  }
  if (count > list) fmt::print("  ... and {} more\n", count - list);
}

ExitCode run_audit(const AuditCommand& command) {
  const Executor executor = make_executor(command.common);
  const Result<Path> path = read_path(command.path_file);
  if (!path) return report(path.error());
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return report(assembly.error());
  note_other_version(*path, *assembly);

  const AuditReport audit = audit_path(*assembly, *path, {executor, progress_printer(command.common)});
  if (!audit.complete)
    return report({ErrorKind::Failed, "the audit was not finished (cancelled); run the command again"});
  if (command.common.json) {
    fmt::print("{}\n", to_json(audit, *assembly, *path).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(audit, *assembly, *path, command.list);
  }
  return audit.holds() ? ExitCode::Done : ExitCode::No;
}

}  // namespace

void add_audit_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand(
      "audit", "Verify that a path holds the guarantee: nothing gets deeper, nothing passes through");
  auto options = std::make_shared<AuditCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("PATH", options->path_file, "Path written by move or plan (*.path.json)")->required();
  command->add_option("--list", options->list, "Number of violations to list (--json lists all)")
      ->type_name("N")
      ->capture_default_str();
  add_common_options(*command, options->common);
  command->footer(
      "Exit code 0: the guarantee holds; 1: it does not. Pairs that the path calls free (--pairs paper, method\n"
      "streams) are not checked until they have been apart, and are listed. The tolerance is that of the path;\n"
      "--deflection and --simplify must be the same as when the path was made.");
  command->callback([options, &exit_code] { exit_code = run_audit(*options); });
}

}  // namespace dismantle::cli
