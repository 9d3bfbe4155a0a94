// SPDX-License-Identifier: Apache-2.0
// The program that isolated_process_test.cpp runs in a child process: its request is a command and its argument, with a
// space between.
#include "dismantle/isolation/isolated_child.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace dismantle;

/// Writes "done", or why the system refused.
Result<Done> answer(IsolatedLine& line, bool done) {
  const std::string text = done ? "done" : std::strerror(errno);
  line.write(text.data(), text.size());
  return Done{};
}

void pause(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

Result<Done> work(std::string_view request, IsolatedLine& line) {
  const std::size_t space = std::min(request.find(' '), request.size());
  const std::string command(request.substr(0, space));
  const std::string argument(request.substr(std::min(space + 1, request.size())));
  if (command == "count") {
    std::vector<std::uint32_t> numbers(std::stoul(argument));
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i * 2654435761u;
    line.write(numbers.data(), 12);
    line.write(numbers.data() + 3, (numbers.size() - 3) * 4);
    return Done{};
  }
  if (command == "echo") return line.write(argument.data(), argument.size()), Done{};
  if (command == "refuse") return line.write("half", 4), Error{ErrorKind::Unreadable, argument};
  if (command == "raise") return std::raise(std::stoi(argument)), Done{};
  if (command == "throw") throw std::runtime_error("unexpected");
  if (command == "exit") _exit(0);
  if (command == "eat") {
    const std::size_t bytes = std::stoul(argument);
    const std::vector<char> eaten(bytes, 1);
    return eaten[bytes / 2] == 1 ? Result<Done>(Done{}) : Error{};
  }
  if (command == "flood") {
    const std::vector<char> piece(std::size_t{1} << 20);
    for (;;) line.write(piece.data(), piece.size());
  }
  if (command == "compute")
    for (double x = 1;; x += 1)
      if (std::sqrt(x) < 0) line.report("never", x);
  if (command == "sleep") return pause(std::stoi(argument)), Done{};
  if (command == "talk") {
    for (int i = 0; i < 5; ++i) {
      pause(150);
      line.report("working", i / 5.0);
    }
    return Done{};
  }
  if (command == "report") return line.report(argument, 0.25), pause(3'600'000), Done{};
  if (command == "malformed") return answer(line, write(3, "\x09nonsense nonsense", 18) == 18);
  if (command == "print") return std::cout << "noise" << std::endl, std::cerr << "noise" << std::endl, Done{};
  if (command == "descriptors") {
    std::string open_ones;
    for (int fd = 0; fd < 1000; ++fd)
      if (fcntl(fd, F_GETFD) >= 0) open_ones += std::to_string(fd) + " ";
    return line.write(open_ones.data(), open_ones.size()), Done{};
  }
  // What a reader that was taken over could try.
  if (command == "read") return answer(line, open(argument.c_str(), O_RDONLY) >= 0);
  if (command == "write") return answer(line, open(argument.c_str(), O_WRONLY) >= 0);
  if (command == "create") return answer(line, open(argument.c_str(), O_RDWR | O_CREAT, 0600) >= 0);
  if (command == "remove") return answer(line, unlink(argument.c_str()) == 0);
  if (command == "connect") return answer(line, socket(AF_INET, SOCK_STREAM, 0) >= 0);
  if (command == "run") return execl("/bin/true", "true", nullptr), answer(line, false);
  if (command == "signal") return answer(line, kill(getppid(), 0) == 0);
  if (command == "fork") {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    return answer(line, child > 0 && waitpid(child, nullptr, 0) == child);
  }
  if (command == "code")
    return answer(line, mmap(nullptr, 4096, PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED);
  if (command == "thread") {
    bool ran = false;
    std::thread([&ran] { ran = true; }).join();
    return answer(line, ran);
  }
  return Error{ErrorKind::Usage, "unknown command"};
}

}  // namespace

int main() {
  return run_isolated_child(work);
}
