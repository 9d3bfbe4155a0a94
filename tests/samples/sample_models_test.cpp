// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"
#include "dismantle/loading/load_assembly.h"
#include "samples/generator/sample_motion.h"
#include "samples/generator/samples.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <Bnd_Box.hxx>
#include <TopLoc_Location.hxx>

namespace dismantle {
namespace {

std::filesystem::path sample_file(const std::string& name, const char* ending) {
  return std::filesystem::path(DISMANTLE_SOURCE_DIR) / "samples" / (name + ending);
}

void expect_near(Vec3 a, Vec3 b, double tolerance, const std::string& name) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << name;
}

class SampleModels : public testing::TestWithParam<const char*> {};

/// The box of the solid in its pose, not of its triangles.
Aabb box_of(const samples::SampleModel& model, const samples::Occurrence& occurrence) {
  Bnd_Box box;
  const TopoDS_Shape shape = model.solid(occurrence.product).shape().Moved(TopLoc_Location(occurrence.placement));
  BRepBndLib::AddOptimal(shape, box, false, false);
  Aabb result;
  box.Get(result.lower.x, result.lower.y, result.lower.z, result.upper.x, result.upper.y, result.upper.z);
  return result;
}

TEST_P(SampleModels, AreTheCommittedOnesAndValid) {
  const samples::SampleModel model = samples::make_sample(GetParam());
  const Result<Assembly> committed = load_assembly(sample_file(GetParam(), ".step"));
  ASSERT_TRUE(committed.ok()) << committed.error().message;
  const std::vector<samples::Occurrence> occurrences = model.occurrences();
  ASSERT_EQ(occurrences.size(), committed->components.size());
  const double tolerance = 2 * committed->deflection;
  for (std::size_t i = 0; i < occurrences.size(); ++i) {
    const Component& component = committed->components[i];
    EXPECT_EQ(occurrences[i].name, component.name);
    const Aabb box = box_of(model, occurrences[i]), bounds = assembled_bounds(component);
    expect_near(box.lower, bounds.lower, tolerance, component.name);
    expect_near(box.upper, bounds.upper, tolerance, component.name);
    EXPECT_TRUE(BRepCheck_Analyzer(model.solid(occurrences[i].product).shape()).IsValid()) << component.name;
  }
}

TEST(SampleModel, WritesTheSameAssemblyAgain) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("dismantle_sample_" + std::to_string(getpid()) + ".step");
  samples::make_microscope().write_step(file);
  const Result<Assembly> remade = load_assembly(file), committed = load_assembly(sample_file("microscope", ".step"));
  std::filesystem::remove(file);
  ASSERT_TRUE(remade.ok()) << remade.error().message;
  ASSERT_TRUE(committed.ok()) << committed.error().message;
  ASSERT_EQ(remade->components.size(), committed->components.size());
  for (std::size_t i = 0; i < remade->components.size(); ++i) {
    EXPECT_EQ(remade->components[i].name, committed->components[i].name);
    EXPECT_EQ(remade->components[i].color, committed->components[i].color);
    EXPECT_EQ(remade->components[i].mesh->faces.size(), committed->components[i].mesh->faces.size());
  }
}

TEST_P(SampleModels, HaveTheCommittedMotion) {
  const Result<Motion> committed = read_motion(sample_file(GetParam(), ".motion.json"));
  ASSERT_TRUE(committed.ok()) << committed.error().message;
  const Motion remade = samples::make_sample_motion(GetParam());
  ASSERT_EQ(remade.moves.size(), committed->moves.size());
  for (std::size_t i = 0; i < remade.moves.size(); ++i) {
    EXPECT_EQ(remade.moves[i].components, committed->moves[i].components);
    ASSERT_EQ(remade.moves[i].targets.size(), committed->moves[i].targets.size());
    for (std::size_t k = 0; k < remade.moves[i].targets.size(); ++k)
      expect_near(remade.moves[i].targets[k].pose.position, committed->moves[i].targets[k].pose.position, 1e-6,
                  remade.moves[i].components.front());
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleModels, testing::Values("microscope", "tooling", "lathe", "robot"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace dismantle
