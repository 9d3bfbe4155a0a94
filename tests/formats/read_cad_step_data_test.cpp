// SPDX-License-Identifier: Apache-2.0
// STEP files of other programs, from the test data beside the repository.
#include "dismantle/loading/load_assembly.h"
#include "tests/support/test_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace dismantle {
namespace {

const std::filesystem::path kAssemblies = data_folder() / "assemblies";

/// All STEP files of one assembly's originals, one after another, in the order of their names.
std::vector<Component> components_of(const std::string& assembly) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kAssemblies / assembly / "original"))
    if (entry.path().extension() == ".stp" || entry.path().extension() == ".step") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Component> components;
  for (const std::filesystem::path& file : files) {
    const Result<Assembly> a = load_assembly(file, {});
    EXPECT_TRUE(a.ok()) << a.error().message;
    if (a) components.insert(components.end(), a->components.begin(), a->components.end());
  }
  return components;
}

class StepData : public ::testing::TestWithParam<const char*> {};

/// The volume and the box of each component agree with those of the manifest's parts, which another program made with
/// other deflections; parts are matched by volume.
TEST_P(StepData, AgreesWithTheManifest) {
  DISMANTLE_NEED(kAssemblies);
  const auto manifest = nlohmann::json::parse(std::ifstream(kAssemblies / GetParam() / "manifest.json"));
  std::vector<double> expected, found;
  for (const auto& part : manifest["parts"]) expected.push_back(part["volume"]);
  for (const Component& c : components_of(GetParam())) {
    EXPECT_TRUE(c.faults.closed()) << c.name;
    EXPECT_FALSE(c.faults.inside_out) << c.name;
    found.push_back(signed_volume(*c.mesh));
  }
  ASSERT_EQ(found.size(), expected.size());
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 0.02 * expected[i]);
}

INSTANTIATE_TEST_SUITE_P(Originals, StepData,
                         ::testing::Values("as1_oc_214", "chrono_pin", "o2ac_fixture", "watch_escapement"),
                         [](const auto& name) { return std::string(name.param); });

TEST(StepDataSet, LeavesNoFaceOutOfFilesAsTheyArePublished) {
  DISMANTLE_NEED(data_folder() / "wild");
  for (const char* file : {"gripper_online_robotics", "klickswipe_probe", "odrive_pcb_v35", "stealthburner_bowden"}) {
    const Result<Assembly> a = load_assembly(data_folder() / "wild" / (std::string(file) + ".step"), {});
    ASSERT_TRUE(a.ok()) << a.error().message;
    // odrive's open part is drawn as sheets.
    const auto open = std::count_if(a->components.begin(), a->components.end(),
                                    [](const Component& c) { return c.faults.open_edges > 0; });
    EXPECT_EQ(open, std::string(file) == "odrive_pcb_v35" ? 1 : 0) << file;
  }
}

TEST(StepDataSet, MeshesTheBreakersPartsClosed) {
  DISMANTLE_NEED(kAssemblies);
  const std::vector<Component> components = components_of("c60_breaker");
  EXPECT_EQ(components.size(), 10u);  // the eleventh is compressed
  for (const Component& c : components) EXPECT_TRUE(c.faults.closed()) << c.name;
}

TEST(StepDataSet, NamesTheProductsOfTheBracketAssembly) {
  DISMANTLE_NEED(kAssemblies);
  const Result<Assembly> a = load_assembly(kAssemblies / "as1_oc_214/original/as1-oc-214.stp", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  for (const char* name : {"plate", "rod", "l-bracket", "l-bracket#2", "nut", "nut#8", "bolt", "bolt#6"})
    EXPECT_TRUE(a->find(name)) << name;
  EXPECT_EQ((*a)[*a->find("nut")].mesh, (*a)[*a->find("nut#8")].mesh);
}

}  // namespace
}  // namespace dismantle
