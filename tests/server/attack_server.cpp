// SPDX-License-Identifier: Apache-2.0
// Attacks a viewer that it starts, for some minutes, and prints the table of docs/security.md: how the viewer answered,
// and its memory before and after. Ends with 1 if it answered anything else than it should.
#include "dismantle/assembly/assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/server/attacks.h"
#include "tests/server/viewer_process.h"
#include "tests/support/meshes.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace dismantle::server::testing_client {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kMegabyte = 1 << 20;
/// How much memory an attack may leave in use: the viewer's allocator keeps some.
constexpr double kMaxGrowth = 160 * kMegabyte;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Allows this process as many open files as the system lets it have. @return the number
std::size_t raise_descriptors() {
  rlimit limit = {};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
  getrlimit(RLIMIT_NOFILE, &limit);
  return limit.rlim_cur;
}

/// Connections that send the head of a request byte by byte, one a second; the owner works meanwhile.
AttackResult attack_slowly(const ServerAddress& address, int count, int seconds) {
  AttackResult result;
  const std::string head = "GET / HTTP/1.1\r\nHost: " + address.host() + "\r\nA: " + std::string(1000, 'x');
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int i = 0; i < count; ++i) slow.push_back(std::make_unique<RawConnection>(address));
  Client owner(address, "a0000000000000000000000000000001");
  owner.state();
  double slowest = 0;
  for (int second = 0; second < seconds; ++second) {
    const Clock::time_point start = Clock::now();
    for (const auto& connection : slow) connection->send(head.substr(static_cast<std::size_t>(second), 1));
    const Clock::time_point asked = Clock::now();
    result.add("the owner's command", owner.command("check")["ok"] ? "done" : "refused", {"done"});
    slowest = std::max(slowest, seconds_since(asked));
    std::this_thread::sleep_until(start + std::chrono::seconds(1));
  }
  for (const auto& connection : slow) {
    connection->receive(std::chrono::milliseconds(1));
    result.add("a slow connection", connection->is_closed() ? "closed" : "open", {"closed"});
  }
  if (slowest > 1) result.failures.push_back("the owner waited for " + std::to_string(slowest) + " s");
  return result;
}

/// As many connections at once as this process may have; the owner works meanwhile.
AttackResult attack_at_once(const ServerAddress& address, std::size_t count) {
  AttackResult result;
  Client owner(address, "a0000000000000000000000000000002");
  owner.state();
  std::vector<std::unique_ptr<RawConnection>> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(std::make_unique<RawConnection>(address));
  result.add("the owner's command", owner.command("check")["ok"] ? "done" : "refused", {"done"});
  std::this_thread::sleep_for(std::chrono::seconds(1));
  for (const auto& connection : all) {
    connection->receive(std::chrono::milliseconds(1));
    result.add("a connection", connection->is_closed() ? "closed" : "open", {"closed", "open"});
  }
  all.clear();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  result.add("a request afterwards", std::to_string(request(address, "GET", "/").status), {"200"});
  return result;
}

/// The times in which two wrong tokens are refused, one wrong at its start and one at its end.
AttackResult compare_times(const ServerAddress& address, int count) {
  AttackResult result;
  std::vector<double> times[2];
  for (int i = 0; i < 2 * count; ++i) {
    std::string token = address.token;
    char& changed = i % 2 == 0 ? token.front() : token.back();
    changed = changed == '0' ? '1' : '0';
    const Clock::time_point start = Clock::now();
    const unsigned status = request(address, "GET", "/api/path.json", {{"Authorization", "Bearer " + token}}).status;
    times[i % 2].push_back(1e6 * seconds_since(start));
    result.add("a wrong token", std::to_string(status), {"401"});
  }
  double mean[2], error = 0;
  for (int k = 0; k < 2; ++k) {
    std::sort(times[k].begin(), times[k].end());
    times[k].resize(times[k].size() / 2);  // the quick half: the slow one is noise
    mean[k] = std::accumulate(times[k].begin(), times[k].end(), 0.0) / static_cast<double>(times[k].size());
    double squares = 0;
    for (const double t : times[k]) squares += (t - mean[k]) * (t - mean[k]);
    error += squares / static_cast<double>(times[k].size() * times[k].size());
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.2f us later, +- %.2f", mean[1] - mean[0], 2 * std::sqrt(error));
  ++result.answers[text];
  return result;
}

class AttackTable {
 public:
  explicit AttackTable(const ViewerProcess& viewer) : viewer_(viewer) {
    std::printf("| attack | answers | memory before, after [MB] | time [s] |\n| --- | --- | --- | --- |\n");
  }

  void add(const char* name, const AttackResult& result, Clock::time_point start, std::size_t before) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const std::size_t after = viewer_.memory();
    std::string answers;
    for (const auto& [answer, count] : result.answers)
      answers += (answers.empty() ? "" : ", ") + answer + " (" + std::to_string(count) + ")";
    std::printf("| %s | %s | %.0f, %.0f | %.1f |\n", name, answers.c_str(), static_cast<double>(before) / kMegabyte,
                static_cast<double>(after) / kMegabyte, seconds_since(start));
    std::fflush(stdout);
    for (const std::string& failure : result.failures) std::fprintf(stderr, "%s: %s\n", name, failure.c_str());
    const bool has_grown = static_cast<double>(after) > static_cast<double>(before) + kMaxGrowth;
    if (has_grown) std::fprintf(stderr, "%s: the memory has grown\n", name);
    has_failed_ |= has_grown || !result.failures.empty();
  }
  template <class Attack>
  void run(const char* name, const Attack& attack) {
    const std::size_t before = viewer_.memory();
    const Clock::time_point start = Clock::now();
    add(name, attack(), start, before);
  }
  bool has_failed() const { return has_failed_; }

 private:
  const ViewerProcess& viewer_;
  bool has_failed_ = false;
};

int run(const fs::path& folder) {
  const std::size_t descriptors = raise_descriptors();
  const fs::path root = folder / "root", outside = folder / "outside";
  fs::create_directories(root);
  fs::create_directories(outside);
  const Assembly assembly = scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {10, 10, 10})),
                                              scenes::component("wall", scenes::box({20.5, -50, -50}, {21, 50, 50}))});
  if (!write_assembly(root / "block.obj", assembly)) return 1;
  const ViewerProcess viewer(root / "block.obj", folder);
  const ServerAddress& at = viewer.address();
  Client(at).state();
  AttackTable table(viewer);
  table.run("wrong Host, DNS rebinding", [&] { return attack_by_host(at); });
  table.run("wrong Origin", [&] { return attack_by_origin(at); });
  table.run("guessed tokens", [&] { return attack_by_token(at, 500); });
  table.run("token wrong at its end rather than its start", [&] { return compare_times(at, 5000); });
  table.run("malformed and oversized HTTP", [&] { return attack_by_http(at); });
  table.run("malformed and oversized WebSocket frames", [&] { return attack_by_frames(at); });
  table.run("paths that lead out", [&] { return attack_by_paths(at, root, outside); });
  table.run("10,000 connections in a row", [&] { return attack_by_many_connections(at, 10'000); });
  const std::size_t at_once = std::min<std::size_t>(descriptors - 50, 10'000);
  table.run((std::to_string(at_once) + " connections at once").c_str(), [&] { return attack_at_once(at, at_once); });
  table.run("200 connections that send a byte a second", [&] { return attack_slowly(at, 200, 35); });
  table.run("5,000 clients with new keys", [&] { return attack_by_many_clients(at, 5000); });
  table.run("50 commands of a megabyte", [&] { return attack_by_large_commands(at, 50); });
  return table.has_failed() ? 1 : 0;
}

}  // namespace
}  // namespace dismantle::server::testing_client

int main() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dismantle-attack-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const int status = dismantle::server::testing_client::run(folder);
  std::filesystem::remove_all(folder);
  return status;
}
