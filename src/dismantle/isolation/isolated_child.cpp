// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_child.h"

#include "dismantle/isolation/child_process.h"
#include "dismantle/isolation/confinement.h"
#include "dismantle/isolation/isolated_request.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>

namespace dismantle {

namespace {

constexpr int kExitUsage = 2;
constexpr double kNearLimit = 0.9;  // of the limit, in memory that was in use at one time

std::string read_standard_input() {
  std::string bytes;
  char piece[4096];
  for (ssize_t count = 0; (count = read(STDIN_FILENO, piece, sizeof piece)) > 0 || (count < 0 && errno == EINTR);)
    if (count > 0) bytes.append(piece, static_cast<std::size_t>(count));
  return bytes;
}

/// True if the process came near its limit: an Error then says less than that, as libraries that ask malloc() take what
/// they do not get for a fault of the file.
bool was_short_of_memory(const IsolationLimits& limits) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) * 1024 > kNearLimit * static_cast<double>(limits.memory_bytes);
}

}  // namespace

int run_isolated_child(const IsolatedWork& work) {
  const std::optional<IsolatedRequest> request =
      isatty(STDIN_FILENO) ? std::nullopt : request_from(read_standard_input());
  if (!request) {
    std::fputs("this program reads models for dismantle (it is no command of its own); run dismantle instead\n",
               stderr);
    return kExitUsage;
  }
  if (!follow_parent(static_cast<pid_t>(request->parent))) return kExitException;
  set_limits(request->limits);
  confine(request->readable);
  // Libraries catch what is thrown then, and go on with half of the file.
  std::set_new_handler([] { _exit(kExitOutOfMemory); });
  const auto checked = [&](IsolatedLine& line) {
    Result<Done> result = work(request->request, line);
    if (!result && was_short_of_memory(request->limits)) throw std::bad_alloc();
    return result;
  };
  _exit(work_for_parent(checked, kLineDescriptor));
}

}  // namespace dismantle
