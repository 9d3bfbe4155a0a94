// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"

#include "dismantle/audit/audit_depth.h"
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
  bool solids = false;
};

std::size_t frame_count(const Path& path) {
  std::size_t count = 0;
  for (const Move& move : path.moves) count += move.frames.size();
  return count;
}

Json to_json(const AuditViolation& v, const Assembly& a) {
  const auto name = [&a](ComponentId id) { return id.valid() ? Json(a[id].name) : Json(nullptr); };
  return {{"kind", name_of(v.kind)}, {"move", v.move == AuditViolation::kAssembledState ? Json(nullptr) : Json(v.move)},
          {"frame", v.frame},        {"t", v.time},
          {"a", name(v.a)},          {"b", name(v.b)},
          {"depth_mm", v.depth},     {"allowed_mm", v.allowed},
          {"message", v.message}};
}

Json to_json(const AuditReport& report, const Assembly& a, const Path& path) {
  Json violations = Json::array(), pairs = Json::array();
  for (const AuditViolation& v : report.violations) violations.push_back(to_json(v, a));
  for (const AuditPairDepth& pair : report.depths)
    pairs.push_back(
        {{"a", a[pair.a].name}, {"b", a[pair.b].name}, {"deepest_mm", pair.deepest}, {"allowed_mm", pair.allowed}});
  return {
      {"format", "dismantle-audit"},
      {"version", 1},
      {"assembly", {{"file", a.source_file}, {"components", a.components.size()}, {"triangles", triangle_count(a)}}},
      {"moves", path.moves.size()},
      {"frames", frame_count(path)},
      {"holds", report.holds()},
      {"tolerance_mm", report.tolerance},
      {"resolution_mm", report.resolution},
      {"samples", report.samples},
      {"seconds", report.seconds},
      {"violations", violations},
      {"pairs", pairs}};
}

void print_text(const AuditReport& report, const Assembly& a, const Path& path, std::size_t list) {
  fmt::print("{} moves, {} frames; tolerance {:.4g} mm; {} samples in {:.2f} s\n", path.moves.size(), frame_count(path),
             report.tolerance, report.samples, report.seconds);
  const auto deepest = std::max_element(
      report.depths.begin(), report.depths.end(), [](const AuditPairDepth& p, const AuditPairDepth& q) {
        return p.deepest / std::max(p.allowed, 1e-300) < q.deepest / std::max(q.allowed, 1e-300);
      });
  if (deepest != report.depths.end())
    fmt::print("deepest relative to its allowance: \"{}\" and \"{}\", {:.4g} mm (allowed: {:.4g} mm)\n",
               a[deepest->a].name, a[deepest->b].name, deepest->deepest, deepest->allowed);
  if (report.holds()) {
    fmt::print("the guarantee holds\n");
    return;
  }
  fmt::print("the guarantee does not hold: {} violation{}\n", report.violations.size(),
             report.violations.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(list, report.violations.size()); ++i) {
    const AuditViolation& v = report.violations[i];
    const bool in_move = v.kind == AuditViolationKind::PathInconsistent && v.move != AuditViolation::kAssembledState;
    fmt::print("  {}: {}{}\n", name_of(v.kind), in_move ? fmt::format("move {}: ", v.move + 1) : "", v.message);
  }
  if (report.violations.size() > list) fmt::print("  ... and {} more\n", report.violations.size() - list);
}

Json to_json(Vec3 v) {
  return {v.x, v.y, v.z};
}

Json to_json(const DepthAuditPair& pair, const Assembly& a) {
  Json json = {{"a", a[pair.a].name},        {"b", a[pair.b].name},   {"initial_depth_mm", pair.initial_depth},
               {"allowed_mm", pair.allowed}, {"parted", pair.parted}, {"violation", nullptr}};
  if (!pair.violated) return json;
  const DepthViolation& v = pair.violation;
  json["violation"] = {{"rule", name_of(v.rule)},
                       {"move", v.move},
                       {"frame", v.frame},
                       {"t", v.time},
                       {"of", a[v.point_of_a ? pair.a : pair.b].name},
                       {"point", to_json(v.point)},
                       {"depth_mm", v.depth},
                       {"allowed_mm", v.allowed},
                       {"greatest_mm", v.greatest},
                       {"message", v.message}};
  return json;
}

Json to_json(const DepthAudit& audit, const Assembly& a, const Path& path) {
  Json pairs = Json::array(), inconsistencies = Json::array();
  for (const DepthAuditPair& pair : audit.pairs) pairs.push_back(to_json(pair, a));
  for (const AuditViolation& v : audit.inconsistencies) inconsistencies.push_back(to_json(v, a));
  return {
      {"format", "dismantle-audit-solids"},
      {"version", 1},
      {"assembly", {{"file", a.source_file}, {"components", a.components.size()}, {"triangles", triangle_count(a)}}},
      {"moves", path.moves.size()},
      {"frames", frame_count(path)},
      {"holds", audit.holds()},
      {"tolerance_mm", audit.tolerance},
      {"slack_mm", audit.slack},
      {"sheets", audit.sheets},
      {"pieces", audit.pieces},
      {"seconds", audit.seconds},
      {"inconsistencies", inconsistencies},
      {"pairs", pairs}};
}

void print_text(const DepthAudit& audit, const Assembly& a, const Path& path, std::size_t list) {
  fmt::print("{} moves, {} frames; tolerance {:.4g} mm, slack {:.4g} mm; {} pieces in {:.2f} s\n", path.moves.size(),
             frame_count(path), audit.tolerance, audit.slack, audit.pieces, audit.seconds);
  if (audit.sheets > 0) fmt::print("{} of {} components bound no volume\n", audit.sheets, a.components.size());
  const std::size_t count = audit.violation_count() + audit.inconsistencies.size();
  if (count == 0) {
    fmt::print("the guarantee holds\n");
    return;
  }
  fmt::print("the guarantee does not hold: {} violation{}\n", count, count == 1 ? "" : "s");
  std::vector<std::string> lines;
  for (const AuditViolation& v : audit.inconsistencies)
    lines.push_back(fmt::format("{}: {}", name_of(v.kind), v.message));
  for (const DepthAuditPair& pair : audit.pairs)
    if (pair.violated) lines.push_back(fmt::format("{}: {}", name_of(pair.violation.rule), pair.violation.message));
  for (std::size_t i = 0; i < std::min(list, lines.size()); ++i) fmt::print("  {}\n", lines[i]);
  if (lines.size() > list) fmt::print("  ... and {} more\n", lines.size() - list);
}

/// Prints an audit, of either kind.
template <class Audit>
ExitCode print(const Audit& audit, const AuditCommand& command, const Assembly& assembly, const Path& path) {
  if (!audit.complete)
    return report({ErrorKind::Failed, "the audit was not finished (cancelled); run the command again"});
  if (command.common.json) {
    fmt::print("{}\n", to_json(audit, assembly, path).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(audit, assembly, path, command.list);
  }
  return audit.holds() ? ExitCode::Done : ExitCode::No;
}

ExitCode run_audit(const AuditCommand& command) {
  const Executor executor = make_executor(command.common);
  const Result<Path> path = read_path(command.path_file);
  if (!path) return report(path.error());
  const Result<Assembly> assembly = load(command.common);
  if (!assembly) return report(assembly.error());
  note_other_version(*path, *assembly);

  const ProgressCallback progress = progress_printer(command.common);
  if (command.solids) return print(audit_depth(*assembly, *path, {executor, progress}), command, *assembly, *path);
  return print(audit_path(*assembly, *path, {executor, progress}), command, *assembly, *path);
}

}  // namespace

void add_audit_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand(
      "audit", "Verify that a path holds the guarantee: components never penetrate more than allowed");
  auto options = std::make_shared<AuditCommand>();
  add_assembly_argument(*command, options->common);
  command->add_option("PATH", options->path_file, "Path written by move or plan (*.path.json)")->required();
  command->add_option("--list", options->list, "Number of violations to list (--json lists all)")
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--solids", options->solids,
                    "Check the depth of solids: no point of a surface is deeper inside another component than allowed");
  add_common_options(*command, options->common);
  command->footer(
      "Exit code 0: the guarantee holds; 1: it does not. Tolerance and allowances are those of the path;\n"
      "--deflection and --simplify must be the same as when the path was made.");
  command->callback([options, &exit_code] { exit_code = run_audit(*options); });
}

}  // namespace dismantle::cli
