// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/audit_path.h"
#include "tests/audit/depth_scenes.h"

#include <gtest/gtest.h>

#include <limits>

namespace dismantle {
namespace {

using audit_scenes::count;
using audit_scenes::messages;
using audit_scenes::move_through;
using depth_scenes::along;

constexpr double kTolerance = 0.01, kInfinity = std::numeric_limits<double>::infinity();
constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};

/// A pin that is `depth` deep in a block, with its pair as the path lists it.
struct PinInBlock {
  Assembly assembly;
  Path path;

  explicit PinInBlock(double depth) {
    assembly = scenes::assembly({scenes::component("block", depth_scenes::block()),
                                 scenes::component("pin", scenes::box({1, 1, -depth}, {4, 4, 5 - depth}))});
    path = audit_scenes::path_of(assembly, kTolerance);
    path.version = kPathVersion;
  }

  PinInBlock& list(PathPairState state, double initial, double allowed) {
    path.pairs = {{"pin", "block", state, initial, allowed}};
    return *this;
  }
  PinInBlock& move(Vec3 direction, const std::vector<double>& distances) {
    path.moves.push_back(move_through({"pin"}, along(direction, distances)));
    return *this;
  }
  AuditReport audit() const { return audit_path(assembly, path); }
};

/// True if the file is inconsistent, and nothing else is wrong.
bool inconsistent(const AuditReport& report) {
  return report.violations.size() == 1 && count(report, AuditViolationKind::PathInconsistent) == 1;
}

TEST(PathPairs, AllowAnOverlapItsInitialDepthAndTheTolerance) {
  for (const double depth : {0.05, 0.5}) {
    PinInBlock scene(depth);
    scene.list(PathPairState::Overlapping, depth, depth + kTolerance);
    EXPECT_TRUE(PinInBlock(scene).move(kDown, {0, 0.95 * kTolerance}).audit().holds());
    EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 1.2 * kTolerance}).audit().holds());
    EXPECT_TRUE(PinInBlock(scene).move(kUp, {0, 3}).audit().holds());
    const AuditReport report = scene.audit();
    ASSERT_EQ(report.pairs.size(), 1u);
    EXPECT_EQ(report.pairs[0].state, PathPairState::Overlapping);
    EXPECT_NEAR(report.pairs[0].initial_depth, depth, 0.1 * kTolerance + 0.002 * depth);
  }
}

TEST(PathPairs, HonourAnAllowanceThatIsLessThanTheOverlapJustifies) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Overlapping, 0.5, 0.505);
  EXPECT_TRUE(PinInBlock(scene).move(kDown, {0, 0.003}).audit().holds());
  EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 0.009}).audit().holds());
  scene.list(PathPairState::Overlapping, 0.4, 0.41);
  EXPECT_TRUE(inconsistent(scene.audit())) << messages(scene.audit());
}

TEST(PathPairs, CannotLicenseThemselves) {
  PinInBlock scene(0.5);
  const double margin = 0.01 * 0.5;
  EXPECT_TRUE(
      PinInBlock(scene).list(PathPairState::Overlapping, 0.5 + 0.9 * margin, 0.51 + 0.9 * margin).audit().holds());
  for (const auto& [initial, allowed] : {std::pair{0.5, 0.6}, {0.6, 0.51}, {2.0, 2.01}, {0.52, 0.53}}) {
    const AuditReport report = PinInBlock(scene).list(PathPairState::Overlapping, initial, allowed).audit();
    EXPECT_TRUE(inconsistent(report)) << initial << " " << allowed << "\n" << messages(report);
  }
  // What the path allows beyond that is not allowed.
  const AuditReport deeper = PinInBlock(scene).list(PathPairState::Overlapping, 0.5, 2).move(kDown, {0, 1}).audit();
  EXPECT_EQ(count(deeper, AuditViolationKind::Depth), 1u);
  EXPECT_EQ(count(deeper, AuditViolationKind::PathInconsistent), 1u);
}

TEST(PathPairs, MayAllowOnePercentOfTheDepthMoreAndNoMoreThanThat) {
  for (const double depth : {0.5, 2.0}) {
    const auto audit_with = [&](double more) {
      const PinInBlock scene = PinInBlock(depth).list(PathPairState::Overlapping, depth, depth + kTolerance + more);
      return scene.audit();
    };
    EXPECT_TRUE(audit_with(0.009 * depth).holds()) << messages(audit_with(0.009 * depth));
    EXPECT_TRUE(inconsistent(audit_with(0.0185 * depth))) << depth;
  }
}

/// Sagittas are allowed where the two may turn in each other, and not for facets elsewhere.
TEST(PathPairs, MayAllowTheSagittasOfFacetsNearTheOtherComponentOnly) {
  const auto audit_with = [](const TriangleMesh& fixed, const TriangleMesh& moving, double depth, double allowed) {
    const Assembly a = scenes::assembly({scenes::component("fixed", fixed), scenes::component("moving", moving)});
    Path path = audit_scenes::path_of(a, kTolerance);
    path.version = kPathVersion;
    path.pairs = {{"fixed", "moving", PathPairState::Overlapping, depth, allowed}};
    return audit_path(a, path);
  };
  const TriangleMesh hole = depth_scenes::blind_hole(48, 5, 12, 15, 30),
                     peg = depth_scenes::prism(depth_scenes::circle(48, 5.02), 20, 45);
  const double sagitta = 5 * (1 - std::cos(std::numbers::pi / 48));
  const AuditReport turning = audit_with(hole, peg, 0.02, 0.02 + kTolerance + 1.8 * sagitta);
  EXPECT_TRUE(turning.holds()) << messages(turning);
  EXPECT_TRUE(turning.pairs.at(0).turns);
  EXPECT_TRUE(inconsistent(audit_with(hole, peg, 0.02, 0.02 + kTolerance + 2.5 * sagitta)));

  // A block with a cylinder beyond each of its sides in turn, whose facets have a sagitta of about 0.1 mm.
  const Vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3 side : sides) {
    TriangleMesh fixed = depth_scenes::block();
    const TriangleMesh far = scenes::moved(depth_scenes::prism(depth_scenes::circle(16, 5), -5, 5), {80 * side, {}});
    const auto first = static_cast<std::uint32_t>(fixed.vertices.size());
    fixed.vertices.insert(fixed.vertices.end(), far.vertices.begin(), far.vertices.end());
    for (const Face& f : far.faces) fixed.faces.push_back({{f.v[0] + first, f.v[1] + first, f.v[2] + first}});
    const TriangleMesh pin = scenes::box({1, 1, -0.5}, {4, 4, 4.5});
    EXPECT_TRUE(audit_with(fixed, pin, 0.5, 0.51).holds());
    EXPECT_TRUE(inconsistent(audit_with(fixed, pin, 0.5, 0.56))) << side.x << " " << side.y << " " << side.z;
    EXPECT_TRUE(inconsistent(audit_with(pin, fixed, 0.5, 0.56))) << side.x << " " << side.y << " " << side.z;
  }
}

TEST(PathPairs, CannotLicenseWhatTouchesOrIsApart) {
  for (const double depth : {0.0, 0.005, -1.0}) {
    const AuditReport report = PinInBlock(depth).list(PathPairState::Overlapping, 0.1, 0.11).audit();
    EXPECT_TRUE(inconsistent(report)) << depth << messages(report);
    EXPECT_TRUE(inconsistent(PinInBlock(depth).list(PathPairState::Overlapping, 0, 0.11).audit()));
  }
}

/// The depth of the path may be an upper bound slightly above the tolerance, though the depth itself is not.
TEST(PathPairs, MayListAPairThatIsAsDeepAsTheTolerance) {
  const PinInBlock scene = PinInBlock(0.96 * kTolerance).list(PathPairState::Overlapping, 0.0105, 0.0205);
  EXPECT_TRUE(scene.audit().holds()) << messages(scene.audit());
  EXPECT_TRUE(inconsistent(PinInBlock(0.8 * kTolerance).list(PathPairState::Overlapping, 0.0105, 0.0205).audit()));
}

TEST(PathPairs, MustListAnOverlapExceptInVersionOne) {
  PinInBlock scene(0.5);
  EXPECT_TRUE(inconsistent(scene.audit())) << messages(scene.audit());
  scene.move(kDown, {0, 0.95 * kTolerance});
  EXPECT_TRUE(inconsistent(scene.audit()));
  scene.path.version = 1;
  EXPECT_TRUE(scene.audit().holds()) << messages(scene.audit());
  scene.move(kDown, {0.95 * kTolerance, 0.1});
  EXPECT_EQ(count(scene.audit(), AuditViolationKind::Depth), 1u);
}

TEST(PathPairs, AreHonouredWhereDeclared) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Declared, 0.5, 2);
  const AuditReport report = PinInBlock(scene).move(kDown, {0, 1.49}).audit();
  EXPECT_TRUE(report.holds()) << messages(report);
  EXPECT_EQ(report.count(PathPairState::Declared), 1u);
  EXPECT_EQ(report.pairs[0].allowed, 2);
  EXPECT_FALSE(PinInBlock(scene).move(kDown, {0, 1.52}).audit().holds());
  EXPECT_TRUE(inconsistent(scene.list(PathPairState::Declared, 0.5, 0.3).audit()));
}

TEST(PathPairs, AreListedAsUncheckedWhereFree) {
  PinInBlock scene(0.5);
  scene.list(PathPairState::Free, 0.5, kInfinity);
  const AuditReport report = PinInBlock(scene).move(kDown, {0, 8}).audit();
  EXPECT_TRUE(report.holds()) << messages(report);
  ASSERT_EQ(report.count(PathPairState::Free), 1u);
  EXPECT_FALSE(report.pairs[0].parted);
  EXPECT_EQ(report.pairs[0].allowed, kInfinity);
}

TEST(PathPairs, HaveTheToleranceOnceTheyHaveBeenApart) {
  for (const PathPairState state : {PathPairState::Overlapping, PathPairState::Declared, PathPairState::Free}) {
    PinInBlock scene(0.5);
    scene.list(state, 0.5, state == PathPairState::Free ? kInfinity : 0.51);
    scene.move(kUp, {0, 0.4, 0.505}).move(kUp, {0.505, 0.495});
    const AuditReport shallow = scene.audit();
    EXPECT_TRUE(shallow.holds()) << messages(shallow);
    EXPECT_TRUE(shallow.pairs[0].parted);
    const AuditReport deep = scene.move(kUp, {0.495, 0.4}).audit();
    ASSERT_EQ(deep.violations.size(), 1u) << messages(deep);
    EXPECT_EQ(deep.violations[0].allowed, kTolerance);
    EXPECT_NE(deep.violations[0].message.find("as they have been apart"), std::string::npos);
    // Not before.
    EXPECT_TRUE(PinInBlock(0.5)
                    .list(state, 0.5, state == PathPairState::Free ? kInfinity : 0.51)
                    .move(kUp, {0, 0.4, 0.5005, 0.2})
                    .audit()
                    .holds());
  }
}

TEST(PathPairs, HaveBeenApartFromATenthOfTheToleranceOn) {
  for (const auto& [gap, parted] : {std::pair{0.08, false}, {0.12, true}, {0.19, true}}) {
    const double out = 0.5 + gap * kTolerance;
    PinInBlock scene(0.5);
    scene.list(PathPairState::Overlapping, 0.5, 0.51).move(kUp, {0, out}).move(kUp, {out, 0.4});
    const AuditReport report = scene.audit();
    EXPECT_EQ(report.pairs.at(0).parted, parted) << gap;
    EXPECT_EQ(report.holds(), !parted) << gap << messages(report);
  }
}

/// Two mitred plates of 0.05 mm that overlap by 0.03 mm at their common edge, from a circuit board, and poses of the
/// first one that a drag led it through: less deep than they are allowed, further apart than a tenth of the tolerance
/// but not than the tolerance, and off.
struct MitredPlates {
  Assembly assembly;
  std::vector<Pose> poses;
};

MitredPlates mitred_plates() {
  const TriangleMesh wide{{{55.529980, 15.156598, 1.102820},
                           {55.329980, 15.354974, 0.307177},
                           {60.919982, 15.354974, 0.307177},
                           {60.719982, 15.156598, 1.102820},
                           {55.529980, 15.108083, 1.090724},
                           {55.329980, 15.306460, 0.295081},
                           {60.719982, 15.108083, 1.090724},
                           {60.919982, 15.306460, 0.295081}},
                          {{{2, 1, 0}},
                           {{2, 0, 3}},
                           {{5, 4, 0}},
                           {{5, 0, 1}},
                           {{6, 3, 0}},
                           {{6, 0, 4}},
                           {{6, 7, 2}},
                           {{6, 2, 3}},
                           {{2, 5, 1}},
                           {{2, 7, 5}},
                           {{7, 6, 4}},
                           {{7, 4, 5}}}};
  const TriangleMesh deep{{{55.576872, 15.154976, 1.102820},
                           {55.378495, 15.354975, 0.307177},
                           {55.378496, 10.654975, 0.307177},
                           {55.576872, 10.854974, 1.102820},
                           {55.528357, 15.154976, 1.114916},
                           {55.329981, 15.354975, 0.319273},
                           {55.528357, 10.854974, 1.114916},
                           {55.329981, 10.654975, 0.319273}},
                          {{{1, 3, 2}},
                           {{1, 0, 3}},
                           {{5, 4, 0}},
                           {{5, 0, 1}},
                           {{0, 6, 3}},
                           {{0, 4, 6}},
                           {{6, 7, 2}},
                           {{6, 2, 3}},
                           {{5, 1, 2}},
                           {{5, 2, 7}},
                           {{4, 7, 6}},
                           {{5, 7, 4}}}};
  return {
      scenes::assembly({scenes::component("wide", wide), scenes::component("deep", deep)}),
      {{{0.000000000, 0.000000000, 0.000000000}, {1.000000000000, 0.000000000000, 0.000000000000, 0.000000000000}},
       {{0.118742632, -0.378661752, -0.252337979}, {0.999983440160, -0.003420777998, -0.003204972888, 0.003338537418}},
       {{-0.005831551, 0.016611965, 0.248451198}, {0.999998299386, -0.000605170098, 0.001735900483, -0.000147121196}},
       {{-0.012105332, 0.026247931, 0.588545876}, {0.999980075356, -0.005339339028, 0.003355240661, -0.000287593252}},
       {{0.005369417, -0.039877244, 1.259921588}, {0.999874857813, -0.014364947707, 0.006622816701, 0.000235139341}},
       {{0.034712554, -0.121999981, 0.914933372}, {0.999936884602, -0.010278157598, 0.004453650764, 0.000866765963}},
       {{0.021442432, -0.121267354, 0.862704313}, {0.999953321108, -0.008520543664, 0.004472333874, 0.000868429567}},
       {{0.086696897, -0.304941558, 0.850264604}, {0.999976540380, -0.002927475876, 0.005653741890, 0.002526613949}},
       {{0.167672203, -0.530194397, 0.831944636}, {0.999956547238, 0.003947112355, 0.007105537468, 0.004564567686}},
       {{0.251166338, -0.835803192, 1.640373572}, {0.999894569643, -0.002952089699, 0.012247947092, 0.007219595291}},
       {{0.365754225, -1.189916707, 2.632556643}, {0.999708999277, -0.011389855283, 0.018528529281, 0.010434632936}},
       {{0.747292347, -1.809463528, 5.057269761}, {0.998999148149, 0.000691877975, 0.041927506158, 0.015566230455}},
       {{0.725861529, -1.714993104, 4.738228133}, {0.998932735129, 0.011783808093, 0.042271243074, 0.014410918228}},
       {{0.680208200, -1.837466090, 4.442284158}, {0.999101876019, 0.007538310741, 0.038622942124, 0.015712528364}},
       {{0.333210015, -1.042518616, 1.364520433}, {0.999876782587, 0.006322238659, 0.011267822752, 0.008915442301}},
       {{0.205816339, -0.363344875, 0.489810639}, {0.999989884106, 0.001359509166, 0.002969415692, 0.003092893512}},
       {{0.314795265, -0.564313866, -0.602258943}, {0.999920802857, 0.010792287477, -0.004002911172, 0.005088344268}},
       {{0.164170225, -0.259566224, 0.318366105}, {0.999942505843, 0.009903079787, 0.003273006674, 0.002490270500}},
       {{0.113793796, -0.090356494, 0.255608375}, {0.999940069929, 0.010547795721, 0.002813854600, 0.000826304312}},
       {{0.117645107, -0.102131605, 0.354927777}, {0.999980912734, 0.005632636195, 0.002389517884, 0.000858942445}}}};
}

TEST(PathPairs, OfThinPartsHaveBeenApartWhereTheyAreFurtherApartThanTheTolerance) {
  const auto [assembly, poses] = mitred_plates();
  Path path = audit_scenes::path_of(assembly, 0.015);
  path.moves = {move_through({"wide"}, poses)};
  const AuditReport report = audit_path(assembly, path);
  EXPECT_TRUE(report.holds()) << messages(report);
  ASSERT_EQ(report.pairs.size(), 1u);
  EXPECT_TRUE(report.pairs[0].parted);
  path.moves[0].frames.resize(16);  // the last pose is 0.012 mm apart
  const AuditReport before = audit_path(assembly, path);
  EXPECT_TRUE(before.holds()) << messages(before);
  EXPECT_FALSE(before.pairs[0].parted);
}

}  // namespace
}  // namespace dismantle
