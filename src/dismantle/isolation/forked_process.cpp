// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/forked_process.h"

#include "dismantle/isolation/child_process.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace dismantle {

namespace {

void redirect_to_null(int descriptor) {
  const int null = open("/dev/null", O_RDWR);
  if (null < 0) return;
  dup2(null, descriptor);
  if (null != descriptor) close(null);
}

[[noreturn]] void run_child(const std::function<Result<Done>(IsolatedLine&)>& work, const IsolationLimits& limits,
                            int descriptor, pid_t parent) {
  if (!follow_parent(parent)) _exit(kExitException);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) redirect_to_null(fd);
  const auto line_end = static_cast<unsigned>(descriptor);
  if (line_end > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, line_end - 1, 0);
  close_range(line_end + 1, ~0u, 0);
  for (const int sig : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) signal(sig, SIG_DFL);
  set_limits(limits);
  _exit(work_for_parent(work, descriptor));
}

}  // namespace

IsolatedResult run_forked(const std::function<Result<Done>(IsolatedLine&)>& work, const IsolationLimits& limits,
                          const ProgressCallback& progress) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_child(work, limits, ends[1], parent);
  }
  close(ends[1]);
  IsolatedResult result;
  if (child > 0) result = listen_to_child(child, ends[0], limits, progress);
  close(ends[0]);
  return result;
}

}  // namespace dismantle
