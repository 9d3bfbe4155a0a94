// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/isolated_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace dismantle {
namespace {

IsolatedResult run(const IsolatedWork& work, const IsolationLimits& limits = {},
                   const ProgressCallback& progress = nullptr) {
  return run_isolated(work, limits, progress);
}

TEST(RunIsolated, ReturnsEveryByteInOrder) {
  std::vector<std::uint32_t> numbers(1'500'000);  // more than one message takes
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i * 2654435761u;
  const IsolatedResult result = run([&](IsolatedLine& line) -> Result<Done> {
    line.write(numbers.data(), 12);
    line.write(numbers.data() + 3, (numbers.size() - 3) * 4);
    return Done{};
  });
  ASSERT_EQ(result.ending, IsolatedEnding::Done);
  ASSERT_EQ(result.bytes.size(), numbers.size() * 4);
  EXPECT_EQ(std::memcmp(result.bytes.data(), numbers.data(), result.bytes.size()), 0);
}

TEST(RunIsolated, PassesOnTheErrorOfTheWork) {
  const IsolatedResult result = run([](IsolatedLine& line) -> Result<Done> {
    line.write("half", 4);
    return Error{ErrorKind::Unreadable, "it is no good"};
  });
  EXPECT_EQ(result.ending, IsolatedEnding::Refused);
  EXPECT_EQ(result.error.kind, ErrorKind::Unreadable);
  EXPECT_EQ(result.error.message, "it is no good");
  EXPECT_TRUE(result.bytes.empty());
}

TEST(RunIsolated, SurvivesSignalsExceptionsAndExits) {
  const IsolatedResult killed = run([](IsolatedLine&) -> Result<Done> {
    std::raise(SIGSEGV);
    return Done{};
  });
  EXPECT_EQ(killed.ending, IsolatedEnding::Crashed);
#if !defined(__SANITIZE_ADDRESS__)  // which turns the signal into an exit
  EXPECT_EQ(killed.signal, SIGSEGV);
#endif
  EXPECT_EQ(run([](IsolatedLine&) -> Result<Done> { throw std::runtime_error("unexpected"); }).ending,
            IsolatedEnding::Crashed);
  EXPECT_EQ(run([](IsolatedLine&) -> Result<Done> { _exit(0); }).ending, IsolatedEnding::Crashed);
}

TEST(RunIsolated, StopsWorkThatExceedsItsMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory is not limited under the sanitizers";
#endif
  IsolationLimits limits;
  limits.memory_bytes = std::uint64_t{64} << 20;
  const auto eat = [](std::size_t bytes) {
    return [bytes](IsolatedLine&) -> Result<Done> {
      std::vector<char> eaten(bytes, 1);
      return eaten[bytes / 2] == 1 ? Result<Done>(Done{}) : Error{};
    };
  };
  EXPECT_EQ(run(eat(std::size_t{16} << 20), limits).ending, IsolatedEnding::Done);
  EXPECT_EQ(run(eat(std::size_t{128} << 20), limits).ending, IsolatedEnding::OutOfMemory);
}

TEST(RunIsolated, StopsWorkThatNeverEnds) {
  IsolationLimits limits;
  limits.cpu_seconds = 0;  // rounded up to a whole second
  const IsolatedResult result = run(
      [](IsolatedLine& line) -> Result<Done> {
        for (double x = 1;; x += 1)
          if (std::sqrt(x) < 0) line.report("never", x);
      },
      limits);
  EXPECT_EQ(result.ending, IsolatedEnding::OutOfTime);
}

TEST(RunIsolated, StopsSilentWorkButNotWorkThatReports) {
  IsolationLimits limits;
  limits.silence_seconds = 0.3;
  const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(150)); };
  const IsolatedResult silent = run(
      [](IsolatedLine&) -> Result<Done> {
        std::this_thread::sleep_for(std::chrono::hours(1));
        return Done{};
      },
      limits);
  EXPECT_EQ(silent.ending, IsolatedEnding::Silent);
  const IsolatedResult talking = run(
      [&](IsolatedLine& line) -> Result<Done> {
        for (int i = 0; i < 5; ++i) {
          pause();
          line.report("working", i / 5.0);
        }
        return Done{};
      },
      limits);
  EXPECT_EQ(talking.ending, IsolatedEnding::Done);
}

TEST(RunIsolated, ReportsProgressAndStopsWhenCancelled) {
  std::string stage;
  double fraction = 0;
  const IsolatedResult result = run(
      [](IsolatedLine& line) -> Result<Done> {
        line.report("slicing", 0.25);
        std::this_thread::sleep_for(std::chrono::hours(1));
        return Done{};
      },
      {},
      [&](std::string_view s, double f) {
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
  const IsolatedResult result = run([](IsolatedLine&) -> Result<Done> {
    std::cout << "noise" << std::endl;
    return Done{};
  });
  EXPECT_EQ(result.ending, IsolatedEnding::Done);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(RunIsolated, InheritsNoFilesOfTheParent) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  const IsolatedResult result = run([&](IsolatedLine& line) -> Result<Done> {
    const bool are_closed = fcntl(ends[0], F_GETFD) < 0 && fcntl(ends[1], F_GETFD) < 0;
    line.write(are_closed ? "closed" : "open", are_closed ? 6 : 4);
    return Done{};
  });
  EXPECT_EQ(result.ending, IsolatedEnding::Done);
  EXPECT_EQ(result.bytes.size(), 6u);
  close(ends[0]);
  close(ends[1]);
}

TEST(RunIsolated, RunsFromSeveralThreadsAtOnce) {
  std::vector<std::thread> threads;
  std::vector<IsolatedResult> results(6);
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&results, i] {
      results[i] = run([i](IsolatedLine& line) -> Result<Done> {
        line.write(&i, sizeof i);
        if (i % 3 == 2) std::raise(SIGKILL);
        return Done{};
      });
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_EQ(results[i].ending, i % 3 == 2 ? IsolatedEnding::OutOfMemory : IsolatedEnding::Done) << i;
    if (results[i].ending != IsolatedEnding::Done) continue;
    ASSERT_EQ(results[i].bytes.size(), sizeof i);
    EXPECT_EQ(std::memcmp(results[i].bytes.data(), &i, sizeof i), 0);
  }
}

}  // namespace
}  // namespace dismantle
