// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/kills.h"

#include "tests/faults/killed_command.h"
#include "tests/faults/killed_server.h"

namespace dismantle::faults {

const std::vector<std::string>& kill_kinds() {
  static const std::vector<std::string> kKinds = {"import", "plan", "export", "batch", "drag", "search"};
  return kKinds;
}

KillRow kill_at_random(const std::string& kind, int kills, std::uint64_t seed, const std::filesystem::path& folder) {
  KillRow row;
  row.kind = kind;
  KillDice dice(seed);
  const std::filesystem::path own = folder / kind;
  if (kind == "drag" || kind == "search") {
    KilledServer server(own);
    for (int k = 0; k < kills; ++k)
      kind == "drag" ? server.kill_during_drag(row, dice) : server.kill_during_search(row, dice);
  } else {
    std::vector<KilledCommand> commands;
    for (const FaultCommand& command : fault_commands(own, kind))
      if (static_cast<int>(commands.size()) < kills) commands.emplace_back(own, command);
    for (int k = 0; k < kills; ++k) commands[static_cast<std::size_t>(k) % commands.size()].kill_once(row, dice);
  }
  std::filesystem::remove_all(own);
  return row;
}

}  // namespace dismantle::faults
