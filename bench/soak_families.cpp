// SPDX-License-Identifier: Apache-2.0
// Random scenes in families, driven at random with the method `certificates`, every path checked by an oracle of its
// own.
//   soak_families [--family NAME] [--members N] [--first N] [--seed S] [--threads N] [--steps N] [--dump DIR]
// Families are named in bench/families/scene.h. Each member runs in a process of its own, which is ended after a
// minute. One row a family, tab-separated; exit code 1 where a member failed:
//   beyond    deeper in each other than allowed           passed  a point of a surface has no ghost left
//   stuck     not moved out along a straight free way     errors  exceptions, crashes, hangs, depths at the start
// With --dump, each member is written as DIR/FAMILY-SEED-NUMBER: parts, tolerance and motions for the program
// `dismantle`.
#include "bench/command_line.h"
#include "bench/families/member.h"
#include "bench/families/scene.h"
#include "bench/timing.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <sstream>

namespace dismantle::families {
namespace {

struct Settings {
  std::string family;
  std::size_t members = 30, first = 0;
  std::uint64_t seed = 1;
  int threads = 1;
  double seconds = 60;  // of a member
  MemberOptions member;
};

/// A member in a process of its own.
struct Child {
  std::uint64_t number = 0;
  pid_t pid = 0;
  int output = -1;
  bench::Stopwatch watch;
  std::string text;
};

std::string to_text(const MemberResult& r) {
  std::ostringstream out;
  out << "\nresult " << r.steps << ' ' << r.slowest_ms << ' ' << r.depth_ratio << ' ' << r.passed_by << ' ' << r.beyond
      << ' ' << r.passed << ' ' << r.stuck << ' ' << r.straight << ' ' << r.errors << ' ' << r.doubted << ' '
      << r.engine_seconds << ' ' << r.seconds << '\n'
      << r.note;
  return out.str();
}

void send(int output, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = write(output, text.data() + at, text.size() - at);
    if (n <= 0) _exit(3);
    at += static_cast<std::size_t>(n);
  }
}

Child start(std::size_t family, std::uint64_t number, const Settings& settings) {
  int ends[2];
  if (pipe(ends) != 0) std::perror("soak_families"), std::exit(1);
  Child child;
  child.number = number;
  child.pid = fork();
  if (child.pid != 0) {
    close(ends[1]);
    child.output = ends[0];
    return child;
  }
  close(ends[0]);
  try {
    const auto report = [&](const std::string& stage) { send(ends[1], stage + ' '); };
    send(ends[1], to_text(run_member({family, settings.seed, number}, settings.member, report)));
  } catch (const std::exception& error) {
    send(ends[1], std::string("\nexception ") + error.what());
  }
  _exit(0);
}

/// What became of a child that has ended or was ended.
MemberResult end(Child& child, bool late) {
  if (late) kill(child.pid, SIGKILL);
  int status = 0;
  waitpid(child.pid, &status, 0);
  close(child.output);
  MemberResult r;
  const std::size_t at = child.text.find("\nresult ");
  if (at != std::string::npos) {
    std::istringstream in(child.text.substr(at + 8));
    in >> r.steps >> r.slowest_ms >> r.depth_ratio >> r.passed_by >> r.beyond >> r.passed >> r.stuck >> r.straight >>
        r.errors >> r.doubted >> r.engine_seconds >> r.seconds;
    in.ignore();
    r.note.assign(std::istreambuf_iterator<char>(in), {});
    return r;
  }
  r.errors = 1;
  r.seconds = child.watch.seconds();
  r.note = (late                  ? "not done in time"
            : WIFSIGNALED(status) ? strsignal(WTERMSIG(status))
                                  : "no result") +
           std::string(" after: ") + child.text;
  return r;
}

/// The sum of a family.
struct Row {
  std::size_t members = 0, steps = 0, beyond = 0, passed = 0, stuck = 0, straight = 0, errors = 0, doubted = 0;
  double depth_ratio = 0, passed_by = 0, slowest_ms = 0, engine_seconds = 0, seconds = 0;
  void add(const MemberResult& r) {
    ++members;
    steps += static_cast<std::size_t>(r.steps);
    beyond += static_cast<std::size_t>(r.beyond);
    passed += static_cast<std::size_t>(r.passed);
    stuck += static_cast<std::size_t>(r.stuck);
    straight += static_cast<std::size_t>(r.straight);
    errors += static_cast<std::size_t>(r.errors);
    doubted += r.doubted;
    depth_ratio = std::max(depth_ratio, r.depth_ratio);
    passed_by = std::max(passed_by, r.passed_by);
    slowest_ms = std::max(slowest_ms, r.slowest_ms);
    engine_seconds += r.engine_seconds;
    seconds += r.seconds;
  }
};

void report(std::size_t family, const MemberResult& r, std::uint64_t number, const Settings& settings) {
  if (r.note.empty()) return;
  std::fprintf(stderr, "  %s\n    again: soak_families --family %s --seed %llu --first %llu --members 1\n      %s\n",
               std::string(kFamilies[family]).c_str(), std::string(kFamilies[family]).c_str(),
               static_cast<unsigned long long>(settings.seed), static_cast<unsigned long long>(number), r.note.c_str());
}

Row run(std::size_t family, const Settings& settings) {
  Row row;
  std::vector<Child> running;
  std::uint64_t next = settings.first;
  const std::uint64_t last = settings.first + settings.members;
  while (next < last || !running.empty()) {
    while (next < last && running.size() < static_cast<std::size_t>(settings.threads))
      running.push_back(start(family, next++, settings));
    std::vector<pollfd> waits;
    for (const Child& child : running) waits.push_back({child.output, POLLIN, 0});
    poll(waits.data(), waits.size(), 200);
    for (std::size_t i = running.size(); i-- > 0;) {
      Child& child = running[i];
      bool done = false;
      if (waits[i].revents != 0) {
        char buffer[4096];
        const ssize_t n = read(child.output, buffer, sizeof buffer);
        if (n > 0) child.text.append(buffer, static_cast<std::size_t>(n));
        done = n <= 0;
      }
      const bool late = !done && child.watch.seconds() > settings.seconds;
      if (!done && !late) continue;
      const MemberResult result = end(child, late);
      report(family, result, child.number, settings);
      row.add(result);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return row;
}

bool parse(int argc, char** argv, Settings& settings) {
  bench::CommandLine line(
      "soak_families [--family NAME] [--members N] [--first N] [--seed S] [--threads N] [--steps N]\n"
      "                     [--seconds S] [--dump DIR]");
  line.option("--family", settings.family);
  line.option("--members", settings.members, 1);
  line.option("--first", settings.first, 0);
  line.option("--seed", settings.seed, 0);
  line.option("--threads", settings.threads, 1);
  line.option("--steps", settings.member.max_steps, 1);
  line.option("--seconds", settings.seconds);
  line.option("--dump", settings.member.dump);
  return line.parse(argc, argv);
}

/// @return the exit code
int run_all(const Settings& settings) {
  std::printf(
      "family\tmembers\tsteps\tbeyond\tdepth/"
      "allowance\tpassed\tpassed_by\tstraight\tstuck\terrors\tdoubted\tslowest_ms\tengine_s\twall_s\n");
  bool good = true, any = false;
  for (std::size_t f = 0; f < kFamilyCount; ++f) {
    if (!settings.family.empty() && settings.family != kFamilies[f]) continue;
    any = true;
    const Row r = run(f, settings);
    good = good && r.beyond + r.passed + r.stuck + r.errors == 0;
    std::printf("%s\t%zu\t%zu\t%zu\t%.3f\t%zu\t%.3g\t%zu\t%zu\t%zu\t%zu\t%.0f\t%.1f\t%.1f\n",
                std::string(kFamilies[f]).c_str(), r.members, r.steps, r.beyond, r.depth_ratio, r.passed, r.passed_by,
                r.straight, r.stuck, r.errors, r.doubted, r.slowest_ms, r.engine_seconds, r.seconds);
    std::fflush(stdout);
  }
  if (!any) std::fprintf(stderr, "soak_families: no family '%s'\n", settings.family.c_str());
  return !any ? bench::kExitUsage : good ? 0 : bench::kExitFailed;
}

}  // namespace
}  // namespace dismantle::families

int main(int argc, char** argv) {
  dismantle::families::Settings settings;
  if (!dismantle::families::parse(argc, argv, settings)) return dismantle::bench::kExitUsage;
  return dismantle::families::run_all(settings);
}
