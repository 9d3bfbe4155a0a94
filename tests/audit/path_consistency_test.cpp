// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/path_consistency.h"

#include "tests/audit/audit_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dismantle {
namespace {

using audit_scenes::messages;
using audit_scenes::move_through;
using audit_scenes::path_of;
using audit_scenes::shifted;

Assembly two_cubes() {
  return scenes::assembly({scenes::component("left", scenes::box({0, 0, 0}, {1, 1, 1})),
                           scenes::component("right", scenes::box({3, 0, 0}, {4, 1, 1}))});
}

/// A valid path.
Path good_path() {
  Path path = path_of(two_cubes(), 0.01);
  path.moves = {move_through({"left"}, {Pose{}, shifted(0, 0, 1), shifted(0, 0, 2)}),
                move_through({"right"}, {Pose{}, shifted(0, 1, 0)}),
                move_through({"left"}, {shifted(0, 0, 2), shifted(0, 0, 30)})};
  path.removed = {"left"};
  return path;
}

/// The number of inconsistencies that the audit finds in the valid path after `spoil`; it must find nothing else.
template <class Spoil>
std::size_t faults_after(const Spoil& spoil) {
  Path path = good_path();
  spoil(path);
  const AuditReport report = audit_path(two_cubes(), path);
  EXPECT_EQ(audit_scenes::count(report, AuditViolationKind::PathInconsistent), report.violations.size())
      << messages(report);
  return report.violations.size();
}

TEST(PathConsistency, FindsNothingWrongWithAGoodPath) {
  EXPECT_EQ(faults_after([](Path&) {}), 0u);
}

TEST(PathConsistency, FindsNamesThatTheAssemblyDoesNotHave) {
  EXPECT_EQ(faults_after([](Path& p) { p.components.push_back("third"); }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[1].components.push_back("third"); }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.removed.push_back("third"); }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.pairs.push_back({"left", "third", PathPairState::Declared, 0, 0.1}); }), 1u);
}

TEST(PathConsistency, FindsDuplicateNames) {
  EXPECT_EQ(faults_after([](Path& p) { p.moves[1].components = {"right", "right"}; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.removed.push_back("left"); }), 1u);
}

TEST(PathConsistency, FindsAFirstFrameThatIsNotThePoseOfTheComponent) {
  EXPECT_EQ(faults_after([](Path& p) { p.moves[2].frames[0].pose.position.x = 1e-8; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[2].frames[0].pose.position.x = 1e-10; }), 0u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[2].frames[0].pose.rotation = quat_about({0, 0, 1}, 1e-7); }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[2].frames[0].pose.rotation = Quat{-1, 0, 0, 0}; }), 0u);
}

TEST(PathConsistency, FindsASetWithoutACommonPose) {
  EXPECT_EQ(faults_after([](Path& p) {
              p.moves[2].components = {"left", "right"};
              p.removed = {"left", "right"};
            }),
            1u);
}

TEST(PathConsistency, FindsTimesThatDoNotStartAtZeroOrRunBackwards) {
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames[0].time = 0.01; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames[2].time = 0.05; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames[2].time = p.moves[0].frames[1].time; }), 0u);
}

TEST(PathConsistency, FindsQuaternionsThatAreNotUnitAndNumbersThatAreNotFinite) {
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames[1].pose.rotation.w = 1.001; }), 1u);
  // A move that cannot be followed leaves its component in place: the later move starts elsewhere.
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames[1].pose.position.x = std::nan(""); }), 2u);
  EXPECT_EQ(faults_after([](Path& p) { p.moves[0].frames.clear(); }), 2u);
}

TEST(PathConsistency, FindsInvalidPairs) {
  EXPECT_EQ(faults_after([](Path& p) { p.pairs = {{"left", "left", PathPairState::Declared, 0, 0.1}}; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.pairs = {{"left", "right", PathPairState::Declared, -0.1, 0.1}}; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.pairs = {{"left", "right", PathPairState::Declared, 0, -0.1}}; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) {
              p.pairs = {{"left", "right", PathPairState::Declared, 0, 0.1},
                         {"right", "left", PathPairState::Declared, 0, 0.2}};
            }),
            1u);
}

TEST(PathConsistency, FindsAnInvalidTolerance) {
  EXPECT_EQ(faults_after([](Path& p) { p.tolerance = -1; }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.tolerance = std::numeric_limits<double>::quiet_NaN(); }), 1u);
}

TEST(PathConsistency, FindsAComponentThatEndsFarAwayAndIsNotListedAsRemoved) {
  EXPECT_EQ(faults_after([](Path& p) { p.removed.clear(); }), 1u);
  EXPECT_EQ(faults_after([](Path& p) { p.removed = {"left", "right"}; }), 0u);
}

}  // namespace
}  // namespace dismantle
