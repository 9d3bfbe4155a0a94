// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/run_command.h"

#include <chrono>
#include <fstream>
#include <iterator>

namespace dismantle::faults {

namespace fs = std::filesystem;
using server::testing_client::SpawnedProgram;
using server::testing_client::SpawnOptions;

namespace {

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

SpawnOptions in_folder(const fs::path& folder, SpawnOptions limits) {
  for (const auto& [name, place] : {std::pair("XDG_CACHE_HOME=", "cache"), std::pair("TMPDIR=", "tmp"),
                                    std::pair("XDG_STATE_HOME=", "state"), std::pair("HOME=", "home")})
    limits.environment.push_back(name + (folder / place).string());
  fs::create_directories(folder / "tmp");
  if (limits.out.empty()) limits.out = folder / "stdout";
  limits.err = folder / "stderr";
  limits.folder = folder;
  limits.own_group = true;
  return limits;
}

CommandEnd run_command(const std::vector<std::string>& arguments, const SpawnOptions& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  SpawnedProgram program(arguments, options);
  CommandEnd end;
  end.exit_code = program.wait();
  end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (fs::is_regular_file(options.out)) end.out = text_of_file(options.out);
  end.err = text_of_file(options.err);
  return end;
}

}  // namespace dismantle::faults
