// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_child.h"

#include "dismantle/isolation/child_process.h"
#include "dismantle/isolation/confinement.h"
#include "dismantle/isolation/isolated_request.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace dismantle {

namespace {

constexpr int kExitUsage = 2;

std::string read_standard_input() {
  std::string bytes;
  char piece[4096];
  for (ssize_t count = 0; (count = read(STDIN_FILENO, piece, sizeof piece)) > 0 || (count < 0 && errno == EINTR);)
    if (count > 0) bytes.append(piece, static_cast<std::size_t>(count));
  return bytes;
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
  _exit(work_for_parent([&](IsolatedLine& line) { return work(request->request, line); }, kLineDescriptor));
}

}  // namespace dismantle
