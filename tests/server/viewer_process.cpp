// SPDX-License-Identifier: Apache-2.0
#include "tests/server/viewer_process.h"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace dismantle::server::testing_client {

namespace fs = std::filesystem;

ViewerProcess::ViewerProcess(const fs::path& file, const fs::path& folder, SpawnOptions limits) : folder_(folder) {
  fs::create_directories(temporary_folder());
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  limits.environment.push_back("XDG_STATE_HOME=" + (folder_ / "state").string());
  limits.environment.push_back("TMPDIR=" + temporary_folder().string());
  limits.err = folder_ / "messages";
  limits.out_pipe = ends[1];
  program_ = std::make_unique<SpawnedProgram>(
      std::vector<std::string>{"view", file.string(), "--no-browser", "--quiet"}, limits);
  close(ends[1]);
  std::string url;
  for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) url += c;
  close(ends[0]);
  const std::size_t colon = url.find(':', 7), mark = url.find("#token=");
  if (mark == std::string::npos) throw std::runtime_error("it printed no URL but: " + url + messages());
  address_ = {static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1))), url.substr(mark + 7)};
}

int ViewerProcess::end(int signal) {
  program_->signal(signal);
  return program_->wait();
}

std::string ViewerProcess::messages() const {
  std::ifstream in(folder_ / "messages");
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path ViewerProcess::proc(const std::string& name) const {
  return fs::path("/proc") / std::to_string(program_->id()) / name;
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
