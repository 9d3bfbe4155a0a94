// SPDX-License-Identifier: Apache-2.0
// Kills the program with SIGKILL at random moments and prints the table of docs/faults.md: what was lost, half-written
// or left. Ends with 1 if a promise of that page was broken.
#include "bench/command_line.h"
#include "tests/faults/kills.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace dismantle::faults {
namespace {

struct Arguments {
  int kills = 60;
  std::uint64_t seed = 1;
  std::string json;
  std::vector<std::string> kinds;
};

/// @return false where the command line is wrong
bool parse(int argc, char** argv, Arguments& arguments) {
  bench::CommandLine line("kill_at_random [--kills N] [--seed S] [--json FILE] [KIND...]");
  line.option("--kills", arguments.kills, 1);
  line.option("--seed", arguments.seed, 0);
  line.option("--json", arguments.json);
  line.words(arguments.kinds, kill_kinds());
  if (!line.parse(argc, argv)) return false;
  if (arguments.kinds.empty()) arguments.kinds = kill_kinds();
  return true;
}

std::string names_text(const KillRow& row) {
  std::string text;
  for (const std::string& name : row.names_left) text += (text.empty() ? " (" : ", ") + name;
  return text.empty() ? text : text + ")";
}

void print(const KillRow& row) {
  std::printf("| %s | %d | %d | %d | %d | %d | %.3f | %d | %d%s |\n", row.kind.c_str(), row.kills, row.before_end,
              row.half_written, row.damaged, row.failed_reruns, row.longest_loss, row.processes_left, row.files_left,
              names_text(row).c_str());
  std::fflush(stdout);
  for (const std::string& sentence : row.violations) std::fprintf(stderr, "%s\n", sentence.c_str());
}

nlohmann::ordered_json to_json(const KillRow& row) {
  return {{"kind", row.kind},
          {"kills", row.kills},
          {"before_end", row.before_end},
          {"half_written", row.half_written},
          {"damaged", row.damaged},
          {"failed_reruns", row.failed_reruns},
          {"longest_loss_s", row.longest_loss},
          {"processes_left", row.processes_left},
          {"files_left", row.files_left},
          {"names_left", row.names_left},
          {"violations", row.violations}};
}

int run(const Arguments& arguments, const std::filesystem::path& folder) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  bool holds = true;
  std::printf(
      "| killed | kills | before the end | outputs half-written | earlier outputs damaged | repetitions failed | "
      "longest loss of a drag [s] | processes left | files left |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const int kinds = static_cast<int>(arguments.kinds.size());
  for (int k = 0; k < kinds; ++k) {
    const int kills = arguments.kills / kinds + (k < arguments.kills % kinds ? 1 : 0);
    const KillRow row = kill_at_random(arguments.kinds[static_cast<std::size_t>(k)], kills,
                                       arguments.seed + static_cast<std::uint64_t>(k), folder);
    print(row);
    rows.push_back(to_json(row));
    holds = holds && row.holds();
  }
  if (!arguments.json.empty())
    std::ofstream(arguments.json) << nlohmann::ordered_json{{"seed", arguments.seed}, {"rows", rows}}.dump(2) << '\n';
  return holds ? 0 : 1;
}

}  // namespace
}  // namespace dismantle::faults

int main(int argc, char** argv) {
  dismantle::faults::Arguments arguments;
  if (!dismantle::faults::parse(argc, argv, arguments)) return dismantle::bench::kExitUsage;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dismantle-kills-" + std::to_string(getpid()));
  int status = dismantle::bench::kExitFailed;
  try {
    status = dismantle::faults::run(arguments, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kill_at_random: %s\n", error.what());
  }
  std::filesystem::remove_all(folder);
  return status;
}
