// SPDX-License-Identifier: Apache-2.0
// Files that Assimp writes of a sample assembly: the components of the STEP file that it is of.
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/same_assembly.h"
#include "tests/support/scratch_folder.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <assimp/Exporter.hpp>

#include <memory>

namespace dismantle {
namespace {

/// A scene with a node and a mesh for each component, in the assembled pose.
std::unique_ptr<aiScene> scene_of(const Assembly& assembly) {
  auto scene = std::make_unique<aiScene>();
  const auto count = static_cast<unsigned>(assembly.components.size());
  scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene->mNumMaterials = 1;
  scene->mMeshes = new aiMesh*[count];
  scene->mNumMeshes = count;
  scene->mRootNode = new aiNode("root");
  auto** children = new aiNode*[count];
  for (unsigned i = 0; i < count; ++i) {
    const TriangleMesh placed = assembled_mesh(assembly.components[i]);
    auto* mesh = scene->mMeshes[i] = new aiMesh;
    mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    mesh->mNumVertices = static_cast<unsigned>(placed.vertices.size());
    mesh->mVertices = new aiVector3D[placed.vertices.size()];
    for (std::size_t v = 0; v < placed.vertices.size(); ++v) {
      const Vec3& p = placed.vertices[v];
      mesh->mVertices[v] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    mesh->mNumFaces = static_cast<unsigned>(placed.faces.size());
    mesh->mFaces = new aiFace[placed.faces.size()];
    for (std::size_t f = 0; f < placed.faces.size(); ++f) {
      mesh->mFaces[f].mNumIndices = 3;
      mesh->mFaces[f].mIndices = new unsigned[3]{placed.faces[f].v[0], placed.faces[f].v[1], placed.faces[f].v[2]};
    }
    children[i] = new aiNode("part" + std::to_string(i));
    children[i]->mNumMeshes = 1;
    children[i]->mMeshes = new unsigned[1]{i};
  }
  scene->mRootNode->addChildren(count, children);
  delete[] children;
  return scene;
}

class AssimpFiles : public ::testing::TestWithParam<std::tuple<const char*, const char*, const char*>> {};

TEST_P(AssimpFiles, GiveTheComponentsOfTheStepFile) {
  const auto& [sample, format, extension] = GetParam();
  const Result<Assembly> step =
      load_assembly(std::filesystem::path(DISMANTLE_SOURCE_DIR) / "samples" / (std::string(sample) + ".step"));
  ASSERT_TRUE(step.ok());
  const ScratchFolder folder;
  const std::filesystem::path file = folder / (std::string("exported") + extension);
  Assimp::Exporter exporter;
  ASSERT_EQ(exporter.Export(scene_of(*step).get(), format, file.string()), AI_SUCCESS) << exporter.GetErrorString();
  ImportOptions options;
  options.units = "mm";
  const Result<Assembly> read = load_assembly(file, options);
  ASSERT_TRUE(read.ok()) << read.error().message;
  expect_same_components(*step, *read, 1e-3, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Samples, AssimpFiles,
                         ::testing::Combine(::testing::Values("microscope", "robot", "tooling"),
                                            ::testing::Values("collada"), ::testing::Values(".dae")));
INSTANTIATE_TEST_SUITE_P(Samples3mf, AssimpFiles,
                         ::testing::Combine(::testing::Values("microscope", "robot", "tooling"),
                                            ::testing::Values("3mf"), ::testing::Values(".3mf")));

}  // namespace
}  // namespace dismantle
