// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_process.h"

#include "dismantle/isolation/child_process.h"
#include "dismantle/isolation/isolated_request.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

namespace dismantle {

namespace {

/// A file descriptor that is closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  int get() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }

 private:
  int descriptor_;
};

/// The same file above the descriptors that the child gets, so that none of them replaces it.
int above(int descriptor) {
  const int copy = descriptor < 0 ? -1 : fcntl(descriptor, F_DUPFD_CLOEXEC, kLineDescriptor + 1);
  if (descriptor >= 0) close(descriptor);
  return copy;
}

/// A file in memory with these bytes, at its start; -1 where the system has none.
int file_of(const std::string& bytes) {
  const int file = memfd_create("request", MFD_CLOEXEC);
  if (file < 0) return -1;
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  if (done == bytes.size() && lseek(file, 0, SEEK_SET) == 0) return file;
  close(file);
  return -1;
}

/// Starts a program with the request as its standard input and `line` as kLineDescriptor; none of the other files of
/// this process, and no signals blocked or ignored. Returns its process, or -1.
pid_t start(const std::filesystem::path& program, int request, int line) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  if (posix_spawn_file_actions_init(&files) != 0) return -1;
  if (posix_spawnattr_init(&attributes) != 0) return posix_spawn_file_actions_destroy(&files), -1;
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  posix_spawn_file_actions_adddup2(&files, request, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, line, kLineDescriptor);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, output, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, kLineDescriptor + 1);

  std::string name = program.string();
  char* arguments[] = {name.data(), nullptr};
  pid_t child = -1;
  if (posix_spawn(&child, name.c_str(), &files, &attributes, arguments, environ) != 0) child = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return child;
}

}  // namespace

IsolatedResult run_isolated(const IsolatedProgram& program, const IsolationLimits& limits,
                            const ProgressCallback& progress) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const Descriptor ours(ends[0]);
  Descriptor theirs(above(ends[1]));
  const Descriptor request(above(file_of(bytes_of({getpid(), limits, program.readable, program.request}))));
  if (theirs.get() < 0 || request.get() < 0) return {};
  const pid_t child = start(program.file, request.get(), theirs.get());
  theirs.close();
  return child < 0 ? IsolatedResult{} : listen_to_child(child, ours.get(), limits, progress);
}

}  // namespace dismantle
