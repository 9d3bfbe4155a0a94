// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/audit_path.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/session/session.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

/// A session of a small scene, with a simulated user.
namespace dismantle::scenes {

inline constexpr double kTableTolerance = 0.01;
inline constexpr int kLongestRun = 20000;
inline const std::vector<ComponentId> kFirst{ComponentId(0)}, kSecond{ComponentId(1)},
    kBoth{ComponentId(0), ComponentId(1)};

/// A session of a scene; its recording is audited at the end.
class Table {
 public:
  explicit Table(Assembly assembly, const CertificateOptions& options = {}, double tolerance = kTableTolerance)
      : assembly_(std::move(assembly)) {
    ClassifyOptions classify;
    classify.tolerance = tolerance;
    session_.emplace(assembly_, *classify_pairs(assembly_, classify), options);
  }
  ~Table() {
    const AuditReport report = audit_path(assembly_, session_->recording());
    EXPECT_TRUE(report.holds());
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  Session& session() { return *session_; }
  const Assembly& scene() const { return assembly_; }
  std::vector<Pose> poses() const { return {session_->poses().begin(), session_->poses().end()}; }
  /// Runs an automatic motion to its end in steps of 10 ms. @return the number of steps
  int let_run() {
    int count = 0;
    const auto runs = [&] {
      return session_->activity() == SessionActivity::Automatic ||
             (session_->playback() != nullptr && session_->playback()->is_playing());
    };
    for (; runs() && count < kLongestRun; ++count) session_->advance(0.01);
    EXPECT_LT(count, kLongestRun) << "it does not end";
    return count;
  }
  const Pose& pose(std::uint32_t component) const { return session_->poses()[component]; }
  /// Drags a set along a straight line in steps of 10 ms, without release.
  StepResult drag(const std::vector<ComponentId>& set, const Vec3& by, int steps) {
    EXPECT_TRUE(session_->hold(set).ok());
    const Pose start = pose(set[0].value);
    StepResult last;
    for (int i = 1; i <= steps; ++i)
      last = session_->drag({start.position + (static_cast<double>(i) / steps) * by, start.rotation}, 0.01 * i);
    return last;
  }
  void move(const std::vector<ComponentId>& set, const Vec3& by, int steps) {
    drag(set, by, steps);
    session_->release();
  }

 private:
  Assembly assembly_;
  std::optional<Session> session_;
};

inline Assembly wall_and_block() {
  return scenes::assembly(
      {component("block", box({0, 0, 0}, {10, 10, 10})), component("wall", box({20.5, -50, -50}, {21, 50, 50}))});
}

/// A pin through two plates, the upper one on the lower one: the pin must come out first.
inline Assembly pinned_plates() {
  return scenes::assembly({component("pin", tube(5, 0, -1, 22, 24)), component("upper", tube(20, 5.02, 10, 20, 24)),
                           component("lower", tube(20, 5.02, 0, 10, 24))});
}

}  // namespace dismantle::scenes
