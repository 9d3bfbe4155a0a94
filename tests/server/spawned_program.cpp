// SPDX-License-Identifier: Apache-2.0
#include "tests/server/spawned_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace dismantle::server::testing_client {

namespace fs = std::filesystem;

namespace {

/// Commands of a shell that set the limits.
std::string limits_text(const SpawnOptions& options) {
  std::string text;
  if (!options.folder.empty()) text += "cd '" + options.folder.string() + "' && ";
  if (options.max_descriptors > 0) text += "ulimit -n " + std::to_string(options.max_descriptors) + "; ";
  if (options.max_file_bytes > 0) text += "ulimit -f " + std::to_string(options.max_file_bytes / 512) + "; ";
  if (options.max_memory_bytes > 0) text += "ulimit -v " + std::to_string(options.max_memory_bytes / 1024) + "; ";
  return text;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

int exit_code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

SpawnedProgram::SpawnedProgram(const std::vector<std::string>& arguments, const SpawnOptions& options) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto open = [&actions](int descriptor, const fs::path& file, int flags) {
    const std::string name = file.empty() ? "/dev/null" : file.string();
    posix_spawn_file_actions_addopen(&actions, descriptor, name.c_str(), flags, 0600);
  };
  open(STDIN_FILENO, {}, O_RDONLY);
  if (options.out_pipe >= 0) {
    posix_spawn_file_actions_adddup2(&actions, options.out_pipe, STDOUT_FILENO);
  } else {
    open(STDOUT_FILENO, options.out, O_WRONLY | O_CREAT | O_TRUNC);
  }
  open(STDERR_FILENO, options.err, O_WRONLY | O_CREAT | O_TRUNC);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  if (options.own_group) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);

  std::vector<std::string> words = {"/bin/sh", "-c", limits_text(options) + R"(exec "$0" "$@")", DISMANTLE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = options.environment;
  const int status =
      posix_spawn(&process_, "/bin/sh", &actions, &attributes, pointers(words).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (status != 0) throw std::runtime_error("the program cannot be started");
}

SpawnedProgram::~SpawnedProgram() {
  if (process_ <= 0) return;
  signal(SIGKILL);
  wait();
}

void SpawnedProgram::signal(int signal) const {
  if (process_ > 0) ::kill(process_, signal);
}

void SpawnedProgram::signal_group(int signal) const {
  if (process_ > 0) ::kill(-process_, signal);
}

int SpawnedProgram::wait() {
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = 0;
  return exit_code_of(status);
}

std::optional<int> SpawnedProgram::wait_for(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (;;) {
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = 0;
      return exit_code_of(status);
    }
    const Clock::duration left = end - Clock::now();
    if (left <= Clock::duration::zero()) return {};
    std::this_thread::sleep_for(std::min<Clock::duration>(left, std::chrono::microseconds(200)));
  }
}

std::vector<pid_t> processes_with(const std::string& variable) {
  std::vector<pid_t> found;
  std::error_code error;
  for (fs::directory_iterator i("/proc", error), end; !error && i != end; i.increment(error)) {
    const int process = std::atoi(i->path().filename().c_str());
    if (process <= 0) continue;
    std::ifstream in(i->path() / "environ", std::ios::binary);  // empty for a process that has ended
    const std::string all = '\0' + std::string(std::istreambuf_iterator<char>(in), {}) + '\0';
    if (all.find('\0' + variable + '\0') != std::string::npos) found.push_back(process);
  }
  return found;
}

}  // namespace dismantle::server::testing_client
