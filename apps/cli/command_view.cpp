// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "apps/cli/option_checks.h"
#include "apps/server/server.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/exec/cuda_device.h"
#include "dismantle/files/user_folders.h"
#include "dismantle/formats/import/file_formats.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

namespace dismantle::cli {

namespace fs = std::filesystem;

namespace {

struct ViewOptions {
  CommonOptions common;
  std::string sample;
  std::vector<std::string> roots;
  std::string web_folder;
  int port = 0;
  bool no_browser = false;
  bool no_journal = false;
  std::string method = "certificates";
};

/// Blocks SIGINT and SIGTERM in this thread and those that it starts: the main thread waits for them.
sigset_t block_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  return set;
}

void report_no_browser() {
  std::fprintf(stderr, "No browser can be opened: open the address above in a browser on this machine.\n");
}

/// Starts a program without the blocked signals. None if it cannot be started.
std::optional<pid_t> spawn(std::string program, std::string argument) {
  char* arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawnattr_t attributes;
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], nullptr, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  if (failed != 0) return {};
  return child;
}

/// Opens the URL in the user's browser if there is a display; prints a note if that fails. The URL contains the token,
/// which is thus visible in the list of processes, but useless on other machines.
void open_browser(const std::string& url) {
  const bool has_display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  const std::optional<pid_t> child = has_display ? spawn("xdg-open", url) : std::nullopt;
  if (!child) return report_no_browser();
  std::thread([pid = *child] {  // some browsers end only when they are closed
    int status = 0;
    if (waitpid(pid, &status, 0) == pid && status != 0) report_no_browser();
  })
      .detach();
}

Result<server::ServerOptions> server_options(const ViewOptions& o) {
  const Executor executor = make_executor(o.common);
  server::ServerOptions options;
  options.port = static_cast<std::uint16_t>(o.port);
  options.roots.assign(o.roots.begin(), o.roots.end());
  if (options.roots.empty() && !o.common.assembly_file.empty())
    options.roots.push_back(fs::absolute(o.common.assembly_file).parent_path());
  if (!o.no_journal) options.state_folder = user_state_folder();
  if (!o.web_folder.empty()) options.web_folder = o.web_folder;
  options.model.import = o.common.import;
  options.model.classify.tolerance = o.common.tolerance;
  options.model.classify.rule = o.common.pairs;
  options.model.classify.declared = o.common.allowed;
  options.model.declared_for = o.common.assembly_file;
  options.model.classify.executor = executor;
  options.model.simplify = o.common.simplify;
  options.model.executor = executor;
  options.model.drag_by_streams = o.method == "streams";
  options.model.device = o.common.device;
  return options;
}

/// Opens the sample or file of the command line. For a path file, the assembly in its folder, with the path as guide.
Result<Done> open(server::Server& server, const ViewOptions& o) {
  const std::string& file = o.common.assembly_file;
  if (!o.sample.empty()) return server.open_sample(o.sample);
  if (file.empty()) return Done{};
  if (!is_path_file(file)) return server.open_file(file);
  const Result<Path> path = read_path(file);
  if (!path) return path.error();
  const Result<fs::path> assembly = assembly_beside(file, *path);
  if (!assembly) return assembly.error();
  return server.open_guided(*assembly, file);
}

Result<Done> run(const ViewOptions& o) {
  if (!o.sample.empty() && !o.common.assembly_file.empty())
    return Error{ErrorKind::Usage, "two assemblies are given (a file and --sample); give only one"};
  if (!o.common.assembly_file.empty() && !fs::exists(o.common.assembly_file))
    return Error{ErrorKind::Unreadable, o.common.assembly_file + " cannot be read (no such file); check the path"};
  if (o.common.device == DeviceChoice::Cuda) {
    const Result<std::string> cuda = cuda_device_name();
    if (!cuda) note_cpu(o.common, cuda.error().message);
    if (o.method != "streams")
      note_cpu(o.common, "only method streams uses a GPU in the viewer; give --method streams");
  }
  const Result<server::ServerOptions> options = server_options(o);
  if (!options) return options.error();

  const sigset_t signals = block_signals();
  Result<std::unique_ptr<server::Server>> started = server::Server::start(*options);
  if (!started) return started.error();
  server::Server& server = **started;
  Result<Done> opened = open(server, o);
  if (!opened) return opened;

  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  if (!o.common.quiet) std::fprintf(stderr, "Viewer running. Press Ctrl+C to stop.\n");
  if (!o.no_browser) open_browser(server.url());
  int signal = 0;
  sigwait(&signals, &signal);
  return Done{};
}

}  // namespace

void add_view_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("view", "Disassemble an assembly interactively in a browser");
  auto options = std::make_shared<ViewOptions>();
  command->add_option(
      "ASSEMBLY", options->common.assembly_file,
      format_names(", ") + ", a folder of meshes, or a *.path.json as a guide (default: choose in the page)");
  command->add_option("--sample", options->sample, "Open a bundled sample")->type_name("NAME");
  command->add_option("--root", options->roots, "A folder whose files the page may open (default: the assembly's)")
      ->type_name("DIR");
  command->add_option("--port", options->port, "Port on 127.0.0.1 and ::1 (default: a free one)")
      ->check(between(1, 65535));
  command->add_flag("--no-browser", options->no_browser, "Only print the URL");
  command->add_flag("--no-journal", options->no_journal, "Do not keep the session on disk or resume one");
  command
      ->add_option("--method", options->method,
                   "Collision method of drags; streams touches or stops, on a GPU if --device says so")
      ->type_name("certificates|streams")
      ->check(one_of({"certificates", "streams"}))
      ->capture_default_str();
  command->add_option("--web", options->web_folder, "Serve the page's files from a folder (for work on the page)")
      ->type_name("DIR")
      ->check(existing_folder());
  add_allow_option(*command, options->common);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    if (const Result<Done> done = run(*options); !done) exit_code = report(done.error());
  });
}

}  // namespace dismantle::cli
