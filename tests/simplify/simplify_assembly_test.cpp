// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_assembly.h"

#include "dismantle/surface/surface_tree.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// Two instances of a tube, a rod and a box.
Assembly mechanism() {
  Assembly a = scenes::assembly({scenes::component("tube", scenes::tube(5, 3, 0, 10, 64, 10)),
                                 scenes::component("tube#2", scenes::tube(5, 3, 0, 10, 64, 10)),
                                 scenes::component("rod", scenes::tube(2.9, 0, -5, 15, 48, 30)),
                                 scenes::component("box", scenes::box({-9, -9, -2}, {9, 9, -1}))});
  a.components[1].mesh = a.components[0].mesh;
  a.components[1].assembly_from_mesh.translation = {20, 0, 0};
  return a;
}

TEST(SimplifyAssembly, ReachesTheTargetAndKeepsNamesPosesAndSolids) {
  const Assembly original = mechanism();
  const Result<SimplifiedAssembly> result = simplify_assembly(original, 1200);
  ASSERT_TRUE(result.ok());
  EXPECT_LE(triangle_count(result->assembly), 1212u);
  EXPECT_GE(triangle_count(result->assembly), 1000u);
  for (std::size_t i = 0; i < original.components.size(); ++i) {
    const Component& c = result->assembly.components[i];
    EXPECT_EQ(c.name, original.components[i].name);
    EXPECT_EQ(c.assembly_from_mesh, original.components[i].assembly_from_mesh);
    EXPECT_TRUE(c.faults.closed());
    EXPECT_TRUE(clean_mesh(*c.mesh).faults.closed());
    EXPECT_EQ(result->components[i].triangles_before, original.components[i].mesh->faces.size());
    EXPECT_EQ(result->components[i].triangles_after, c.mesh->faces.size());
  }
}

TEST(SimplifyAssembly, InstancesGoOnSharingTheirMesh) {
  const Result<SimplifiedAssembly> result = simplify_assembly(mechanism(), 800);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->assembly.components[0].mesh, result->assembly.components[1].mesh);
  EXPECT_EQ(result->components[0].error, result->components[1].error);
}

TEST(SimplifyAssembly, SmallComponentsStayAsTheyAre) {
  const Assembly original = mechanism();
  const Result<SimplifiedAssembly> result = simplify_assembly(original, 100);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->assembly.components[3].mesh, original.components[3].mesh);
  EXPECT_EQ(result->components[3].error.upper, 0);
  for (const ComponentSimplification& c : result->components) EXPECT_GE(c.triangles_after, 12u);
}

TEST(SimplifyAssembly, TheErrorBoundsHowFarTheSurfaceMovedAndIsAddedUp) {
  Assembly original = mechanism();
  original.simplification_error = 0.125;
  const Result<SimplifiedAssembly> result = simplify_assembly(original, 500);
  ASSERT_TRUE(result.ok());
  double largest = 0;
  for (std::size_t i = 0; i < original.components.size(); ++i) {
    const DistanceBounds& error = result->components[i].error;
    largest = std::max(largest, error.upper);
    const SurfaceTree simplified(*result->assembly.components[i].mesh);
    const TriangleMesh& mesh = *original.components[i].mesh;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      for (int a = 0; a <= 6; ++a)
        for (int b = 0; a + b <= 6; ++b)
          EXPECT_LE(simplified.distance(t[0] + a / 6.0 * (t[1] - t[0]) + b / 6.0 * (t[2] - t[0])).distance,
                    error.upper + 1e-14);
    }
  }
  EXPECT_GT(largest, 0);
  EXPECT_EQ(result->assembly.simplification_error, 0.125 + largest);
}

TEST(SimplifyAssembly, ChangesNothingIfTheAssemblyIsSmallEnough) {
  const Assembly original = mechanism();
  const Result<SimplifiedAssembly> result = simplify_assembly(original, 1'000'000);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(triangle_count(result->assembly), triangle_count(original));
  EXPECT_EQ(result->assembly.simplification_error, 0);
}

TEST(SimplifyAssembly, CanBeCancelled) {
  SimplifyOptions options;
  options.progress = [](std::string_view, double) { return false; };
  const Result<SimplifiedAssembly> result = simplify_assembly(mechanism(), 100, options);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::Failed);
}

TEST(SimplifyAssembly, GivesTheSameOnEveryExecutor) {
  SimplifyOptions options;
  const Result<SimplifiedAssembly> serial = simplify_assembly(mechanism(), 600, options);
  options.executor = Executor(ExecutorKind::Threads, 3);
  const Result<SimplifiedAssembly> threads = simplify_assembly(mechanism(), 600, options);
  ASSERT_TRUE(serial.ok() && threads.ok());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(*serial->assembly.components[i].mesh, *threads->assembly.components[i].mesh);
    EXPECT_EQ(serial->components[i].error, threads->components[i].error);
  }
}

}  // namespace
}  // namespace dismantle
