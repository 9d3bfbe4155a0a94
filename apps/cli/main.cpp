// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/usage_error.h"
#include "apps/server/lack_of_memory.h"
#include "dismantle/exec/cuda_device.h"

#include <execinfo.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <system_error>
#include <vector>

namespace dismantle::cli {
namespace {

Error output_error(const std::string& why) {
  return {ErrorKind::Failed, "the standard output cannot be written (" + why + "); check the free space"};
}

/// The error for the exception that is being handled.
Error error_of_exception() {
  Error no_memory{ErrorKind::Failed, "out of memory (the assembly is too large for this machine); try --simplify N"};
  try {
    throw;
  } catch (const CudaError& error) {
    return {ErrorKind::Failed, std::string("the CUDA device failed (") + error.what() + "); try --device cpu"};
  } catch (const std::exception& error) {
    if (server::is_lack_of_memory(error)) return no_memory;
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && std::ferror(stdout) != 0) return output_error(system->code().message());
    return {ErrorKind::Failed,
            std::string("internal failure (") + error.what() + "); please report it with the command line"};
  } catch (...) {
    return {ErrorKind::Failed, "internal failure (an unknown exception); please report it with the command line"};
  }
}

/// Ends the program in order where an exception leaves a thread: journals are whole then, as after a kill.
[[noreturn]] void end_by_exception() {
  static std::atomic<bool> is_ending{false};
  thread_local bool is_mine = false;
  constexpr int kFailed = static_cast<int>(ExitCode::Failed);
  if (is_mine) {  // no memory was left for what follows
    constexpr char kText[] = "dismantle: out of memory (nothing is left to say more); free memory\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
    std::_Exit(kFailed);
  }
  while (is_ending.exchange(true)) ::pause();  // another thread is at it
  is_mine = true;
  if (!std::current_exception()) std::abort();
  report(error_of_exception());
  std::_Exit(kFailed);
}

/// Flushes what was printed. @return the exit code: `code`, or Failed if not all of it arrived
/// @param earlier_error errno, if something was flushed before
ExitCode finish_output(ExitCode code, int earlier_error) {
  errno = earlier_error;
  const bool is_whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return is_whole ? code : report(output_error(errno != 0 ? std::strerror(errno) : "not all of it arrived"));
}

}  // namespace
}  // namespace dismantle::cli

int main(int argc, char** argv) {
  using namespace dismantle::cli;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large is an error like a full disk
  std::set_terminate(end_by_exception);
  // glibc loads libgcc_s when a thread is first unwound, and aborts if there is no memory for it then; backtrace()
  // loads it now.
  void* frame = nullptr;
  backtrace(&frame, 1);
  CLI::App app{
      "dismantle: virtual disassembly of CAD assemblies, with continuous collision handling.\n"
      "Lengths are millimetres, angles radians. 'dismantle COMMAND --help' lists the options of a command.",
      "dismantle"};
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->label("Subcommands", "Commands");
  app.set_version_flag("--version", "dismantle " DISMANTLE_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 negative result, 2 wrong usage, 3 unreadable input, 4 failed.");

  ExitCode exit_code = ExitCode::Done;
  add_info_command(app, exit_code);
  add_check_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_audit_command(app, exit_code);
  add_simplify_command(app, exit_code);
  add_render_command(app, exit_code);
  add_move_command(app, exit_code);
  add_plan_command(app, exit_code);
  add_why_command(app, exit_code);
  add_export_command(app, exit_code);
  add_batch_command(app, exit_code);
  add_sample_command(app, exit_code);
  add_view_command(app, exit_code);

  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (arguments.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(ExitCode::Usage);
  }
  if (std::find(arguments.begin(), arguments.end(), "--json") != arguments.end()) report_errors_as_json();
  if (const std::optional<dismantle::Error> unknown = unknown_command(app, arguments))
    return static_cast<int>(report(*unknown));

  int print_error = 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    errno = 0;
    exit_code = static_cast<ExitCode>(app.exit(help));
    print_error = errno;
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(report(usage_error(app, error, arguments)));
  } catch (...) {
    return static_cast<int>(report(error_of_exception()));
  }
  return static_cast<int>(finish_output(exit_code, print_error));
}
