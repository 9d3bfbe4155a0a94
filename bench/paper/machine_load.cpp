// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/machine_load.h"

#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace dismantle {

namespace {

/// Time that all cores together have worked since the system started [s].
double worked_seconds() {
  std::ifstream file("/proc/stat");
  std::string cpu;
  // In user mode, of lower priority, in the kernel, idle, waiting, for interrupts (two kinds), taken by the host.
  double user = 0, low = 0, kernel = 0, idle = 0, waiting = 0, hard = 0, soft = 0, taken = 0;
  if (!(file >> cpu >> user >> low >> kernel >> idle >> waiting >> hard >> soft >> taken)) return 0;
  return (user + low + kernel + hard + soft + taken) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

double busy_cores(double seconds) {
  const double before = worked_seconds();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  return (worked_seconds() - before) / seconds;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace dismantle
