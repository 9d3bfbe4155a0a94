// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_process.h"

#include "dismantle/isolation/confinement.h"
#include "dismantle/isolation/isolated_request.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

/// Runs a command of isolated_probe.cpp.
IsolatedResult run(const std::string& command, const IsolationLimits& limits = {},
                   const ProgressCallback& progress = nullptr, const std::vector<fs::path>& readable = {}) {
  return run_isolated({ISOLATED_PROBE, command, readable}, limits, progress);
}

std::string text_of(const IsolatedResult& result) {
  return {reinterpret_cast<const char*>(result.bytes.data()), result.bytes.size()};
}

TEST(RunIsolated, ReturnsEveryByteInOrder) {
  constexpr std::uint32_t kCount = 1'500'000;  // more than one message takes
  const IsolatedResult result = run("count " + std::to_string(kCount));
  ASSERT_EQ(result.ending, IsolatedEnding::Done);
  ASSERT_EQ(result.bytes.size(), kCount * 4);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    std::uint32_t number = 0;
    std::memcpy(&number, &result.bytes[4 * i], 4);
    ASSERT_EQ(number, i * 2654435761u) << i;
  }
}

TEST(RunIsolated, PassesOnTheErrorOfTheWork) {
  const IsolatedResult result = run("refuse it is no good");
  EXPECT_EQ(result.ending, IsolatedEnding::Refused);
  EXPECT_EQ(result.error.kind, ErrorKind::Unreadable);
  EXPECT_EQ(result.error.message, "it is no good");
  EXPECT_TRUE(result.bytes.empty());
}

TEST(RunIsolated, SurvivesSignalsExceptionsAndExits) {
  const IsolatedResult killed = run("raise " + std::to_string(SIGSEGV));
  EXPECT_EQ(killed.ending, IsolatedEnding::Crashed);
#if !defined(__SANITIZE_ADDRESS__)  // which turns the signal into an exit
  EXPECT_EQ(killed.signal, SIGSEGV);
#endif
  EXPECT_EQ(run("throw").ending, IsolatedEnding::Crashed);
  EXPECT_EQ(run("exit").ending, IsolatedEnding::Crashed);
}

TEST(RunIsolated, SaysThatAProgramIsMissing) {
  EXPECT_EQ(run_isolated({"/no/such/program", "echo", {}}, {}, nullptr).ending, IsolatedEnding::NotStarted);
}

TEST(RunIsolated, StopsWorkThatExceedsItsMemory) {
  if (kUnderSanitizer) GTEST_SKIP() << "memory is not limited under the sanitizers";
  IsolationLimits limits;
  limits.memory_bytes = std::uint64_t{64} << 20;
  EXPECT_EQ(run("eat " + std::to_string(16 << 20), limits).ending, IsolatedEnding::Done);
  EXPECT_EQ(run("eat " + std::to_string(128 << 20), limits).ending, IsolatedEnding::OutOfMemory);
}

TEST(RunIsolated, StopsAChildThatSendsWithoutEndOrNonsense) {
  IsolationLimits limits;
  limits.memory_bytes = std::uint64_t{64} << 20;
  EXPECT_EQ(run("flood", limits).ending, IsolatedEnding::Crashed);
  EXPECT_EQ(run("malformed").ending, IsolatedEnding::Crashed);
}

TEST(RunIsolated, StopsWorkThatNeverEnds) {
  IsolationLimits limits;
  limits.cpu_seconds = 0;  // rounded up to a whole second
  EXPECT_EQ(run("compute", limits).ending, IsolatedEnding::OutOfTime);
}

TEST(RunIsolated, StopsSilentWorkButNotWorkThatReports) {
  IsolationLimits limits;
  limits.silence_seconds = 0.5;
  EXPECT_EQ(run("sleep 3600000", limits).ending, IsolatedEnding::Silent);
  EXPECT_EQ(run("talk", limits).ending, IsolatedEnding::Done);
}

TEST(RunIsolated, ReportsProgressAndStopsWhenCancelled) {
  std::string stage;
  double fraction = 0;
  const IsolatedResult result = run("report slicing", {}, [&](std::string_view s, double f) {
    stage = s;
    fraction = f;
    return s != "slicing";
  });
  EXPECT_EQ(result.ending, IsolatedEnding::Cancelled);
  EXPECT_EQ(stage, "slicing");
  EXPECT_EQ(fraction, 0.25);
}

TEST(RunIsolated, SilencesTheStandardOutput) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run("print").ending, IsolatedEnding::Done);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(RunIsolated, InheritsNoFilesOfTheParent) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(text_of(run("descriptors")), "0 1 2 3 ");  // the request, nothing twice, and the channel
  close(ends[0]);
  close(ends[1]);
}

TEST(RunIsolated, WorksWithoutStandardInput) {
  const int kept = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  EXPECT_EQ(text_of(run("echo this")), "this");
  dup2(kept, STDIN_FILENO);
  close(kept);
}

TEST(RunIsolated, RunsFromSeveralThreadsAtOnce) {
  std::vector<std::thread> threads;
  std::vector<IsolatedResult> results(6);
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&results, i] {
      results[i] = run(i % 3 == 2 ? "raise " + std::to_string(SIGKILL) : "echo " + std::to_string(i));
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_EQ(results[i].ending, i % 3 == 2 ? IsolatedEnding::OutOfMemory : IsolatedEnding::Done) << i;
    EXPECT_EQ(text_of(results[i]), i % 3 == 2 ? "" : std::to_string(i));
  }
}

TEST(RunIsolated, LeavesAChildOnlyReadingAndComputing) {
  if (kUnderSanitizer) GTEST_SKIP() << "nothing is confined under the sanitizers";
  EXPECT_EQ(text_of(run("thread")), "done");
  const std::string refused = std::strerror(EPERM);
  for (const char* command : {"connect", "run", "fork", "signal", "code"})
    EXPECT_EQ(text_of(run(command)), refused) << command;
}

TEST(RunIsolated, LetsAChildReadWhatItMayAndChangeNothing) {
  if (kUnderSanitizer) GTEST_SKIP() << "nothing is confined under the sanitizers";
  const fs::path folder = fs::path(testing::TempDir()) / "isolated";
  fs::remove_all(folder);
  fs::create_directories(folder / "model" / "textures");
  const fs::path secret = folder / "secret.txt", beside = folder / "model" / "textures" / "beside.txt";
  std::ofstream(secret) << "secret";
  std::ofstream(beside) << "beside";
  fs::create_symlink(secret, folder / "model" / "link.txt");
  const std::vector<fs::path> readable = {folder / "model"};
  const auto attempt = [&](const std::string& command, const fs::path& file) {
    return text_of(run(command + " " + file.string(), {}, nullptr, readable));
  };
  EXPECT_EQ(attempt("read", beside), "done");
  for (const char* command : {"write", "create", "remove"})
    EXPECT_EQ(attempt(command, beside), std::strerror(EPERM)) << command;
  EXPECT_EQ(attempt("create", folder / "model" / "new.txt"), std::strerror(EPERM));
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 1)
    GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_EQ(attempt("read", secret), std::strerror(EACCES));
  EXPECT_EQ(attempt("read", folder / "model" / "link.txt"), std::strerror(EACCES));
  EXPECT_EQ(attempt("read", folder / "model" / ".." / "secret.txt"), std::strerror(EACCES));
  EXPECT_EQ(attempt("read", "/etc/hostname"), std::strerror(EACCES));
  EXPECT_TRUE(fs::exists(beside));
  fs::remove_all(folder);
}

TEST(IsolatedRequest, ComesBackAsItWasAndRefusesEveryPartOfItself) {
  const IsolatedRequest request{4711, {5, 2.5, 9}, {"/a folder", "/b"}, std::string("ab\0c", 4)};
  const std::string bytes = bytes_of(request);
  const std::optional<IsolatedRequest> back = request_from(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->parent, 4711);
  EXPECT_EQ(back->limits.memory_bytes, 5u);
  EXPECT_EQ(back->limits.cpu_seconds, 2.5);
  EXPECT_EQ(back->readable, request.readable);
  EXPECT_EQ(back->request, request.request);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(request_from(bytes.substr(0, size))) << size;
  EXPECT_FALSE(request_from(bytes + "x"));
}

}  // namespace
}  // namespace dismantle
