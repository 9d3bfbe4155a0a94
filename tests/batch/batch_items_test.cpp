// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_items.h"

#include "tests/batch/batch_fixture.h"

namespace dismantle::batch {
namespace {

class BatchItems : public BatchFolder {
 protected:
  std::vector<BatchItem> find(const BatchSelection& selection = {}, const std::string& options = "") const {
    Result<std::vector<BatchItem>> items = find_batch_items(root_, selection, options);
    EXPECT_TRUE(items.ok()) << items.error().message;
    return items ? *items : std::vector<BatchItem>{};
  }
  std::string names(const BatchSelection& selection = {}) const {
    std::string text;
    for (const BatchItem& item : find(selection)) text += item.name + " ";
    return text;
  }
  std::string key(const std::string& name, const std::string& options = "") const {
    for (const BatchItem& item : find({}, options))
      if (item.name == name) return item.key;
    return {};
  }
};

TEST_F(BatchItems, AreTheAssemblyFilesAtEveryDepthInOrder) {
  for (const char* name : {"z.step", "a/b/c.STP", "a/b.glb", "a/notes.txt", ".hidden/d.step", "a/.e.step"})
    write(name, "x");
  EXPECT_EQ(names(), "a/b.glb a/b/c.STP z.step ");
}

TEST_F(BatchItems, AreFoldersOfMeshesOrSingleMeshFiles) {
  for (const char* name : {"pair/one.obj", "pair/two.stl", "pair/readme", "single/part.ply"}) write(name, "x");
  EXPECT_EQ(names(), "pair single/part.ply ");
  BatchSelection each;
  each.meshes = MeshGrouping::File;
  EXPECT_EQ(names(each), "pair/one.obj pair/two.stl single/part.ply ");
}

TEST_F(BatchItems, AreTheFolderItselfIfItContainsMeshes) {
  write("one.obj", "x");
  write("two.obj", "x");
  ASSERT_EQ(names(), ". ");
  EXPECT_EQ(find()[0].input, root_);
}

TEST_F(BatchItems, CanBeChosenByPatternAndLeaveOutTheOutput) {
  for (const char* name : {"a/x.step", "b/x.step", "out/x.step/plan.step"}) write(name, "x");
  EXPECT_EQ(names({MeshGrouping::Folder, "a/*", {}}), "a/x.step ");
  EXPECT_EQ(names({MeshGrouping::Folder, "", root_ / "out"}), "a/x.step b/x.step ");
}

TEST_F(BatchItems, HaveSeparateOutputFolders) {
  for (const char* name : {"a/b.step", "a__b.step"}) write(name, "x");
  const std::vector<BatchItem> items = find();
  ASSERT_EQ(items.size(), 2u);
  EXPECT_NE(items[0].folder, items[1].folder);
  EXPECT_EQ(items[0].folder.find('/'), std::string::npos);
}

TEST_F(BatchItems, HaveKeysThatChangeWithTheInputAndTheOptionsOnly) {
  write("a.step", "x");
  write("b.step", "x");
  const std::string before = key("a.step");
  EXPECT_EQ(key("a.step"), before);
  EXPECT_NE(key("b.step"), before);
  EXPECT_NE(key("a.step", "tolerance=1"), before);
  write("b.step", "longer");
  EXPECT_EQ(key("a.step"), before);
  write("a.step", "longer");
  EXPECT_NE(key("a.step"), before);
}

TEST_F(BatchItems, HaveKeysThatCoverReferencedFiles) {
  write("robot/urdf/arm.urdf", "x");
  write("robot/meshes/link.stl", "x");
  write("scene/scene.gltf", "x");
  write("scene/buffers/0.bin", "x");
  const std::string arm = key("robot/urdf/arm.urdf"), scene = key("scene/scene.gltf");
  write("robot/meshes/link.stl", "longer");
  EXPECT_NE(key("robot/urdf/arm.urdf"), arm);
  EXPECT_EQ(key("scene/scene.gltf"), scene);
  write("scene/buffers/0.bin", "longer");
  EXPECT_NE(key("scene/scene.gltf"), scene);
}

TEST_F(BatchItems, AreRefusedIfThereAreNone) {
  write("notes.txt", "x");
  const Result<std::vector<BatchItem>> none = find_batch_items(root_, {}, "");
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::Unreadable);
  EXPECT_FALSE(find_batch_items(root_ / "missing", {}, "").ok());
}

}  // namespace
}  // namespace dismantle::batch
