// SPDX-License-Identifier: Apache-2.0
#include "tests/server/viewer_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace dismantle::server::testing_client {

namespace fs = std::filesystem;

ViewerProcess::ViewerProcess(const fs::path& file, const fs::path& folder, int max_descriptors) : folder_(folder) {
  fs::create_directories(temporary_folder());
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const std::string errors = (folder_ / "messages").string();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const std::string limit = max_descriptors > 0 ? "ulimit -n " + std::to_string(max_descriptors) + "; " : "";
  std::vector<std::string> texts = {"/bin/sh", "-c", limit + R"(exec "$0" view "$1" --no-browser --quiet)",
                                    DISMANTLE_PROGRAM, file.string()};
  std::vector<std::string> places = {"XDG_STATE_HOME=" + (folder_ / "state").string(),
                                     "TMPDIR=" + temporary_folder().string()};
  std::vector<char*> arguments, environment;
  for (std::string& text : texts) arguments.push_back(text.data());
  for (std::string& place : places) environment.push_back(place.data());
  arguments.push_back(nullptr);
  environment.push_back(nullptr);
  const int status = posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (status != 0) throw std::runtime_error("the program cannot be started");
  std::string url;
  for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
  close(ends[0]);
  const std::size_t colon = url.find(':', 7), mark = url.find("#token=");
  if (mark == std::string::npos) throw std::runtime_error("it printed no URL but: " + url + messages());
  address_ = {static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1))), url.substr(mark + 7)};
}

ViewerProcess::~ViewerProcess() {
  if (process_ > 0) end(SIGKILL);
}

int ViewerProcess::end(int signal) {
  kill(process_, signal);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string ViewerProcess::messages() const {
  std::ifstream in(folder_ / "messages");
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path ViewerProcess::proc(const std::string& name) const {
  return fs::path("/proc") / std::to_string(process_) / name;
}

std::size_t ViewerProcess::memory() const {
  std::ifstream in(proc("statm"));
  std::size_t all = 0, resident = 0;
  in >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

double ViewerProcess::processor_seconds() const {
  std::ifstream in(proc("stat"));
  std::string text(std::istreambuf_iterator<char>(in), {});
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::size_t ViewerProcess::descriptors() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(proc("fd")), fs::directory_iterator()));
}

}  // namespace dismantle::server::testing_client
