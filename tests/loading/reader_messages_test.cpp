// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/reader_messages.h"

#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/reader_program.h"
#include "tests/support/meshes.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace dismantle {
namespace {

TEST(ReaderMessages, ARequestComesBackAsItWasAndRefusesEveryPartOfItself) {
  ReaderRequest request{"1.2", "/a/b.step", {}};
  request.options.units = "in";
  request.options.deflection = 0.25;
  request.options.angular_deflection = 0.5;
  request.options.solids = Solids::Join;
  request.options.limits = {1, 2, 3, 0, 0};
  request.options.reference_folders = {"/x", "/y z"};
  const std::string bytes = bytes_of(request);
  const std::optional<ReaderRequest> back = reader_request_from(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(bytes_of(*back), bytes);
  EXPECT_EQ(back->file, request.file);
  EXPECT_EQ(back->options.solids, Solids::Join);
  EXPECT_EQ(back->options.reference_folders, request.options.reference_folders);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(reader_request_from(bytes.substr(0, size))) << size;
}

TEST(ReaderMessages, AnAnswerComesBackAsItWasAndRefusesEveryPartOfItself) {
  ImportedAssembly imported;
  imported.assembly = scenes::assembly({scenes::component("box", scenes::box({0, 0, 0}, {1, 1, 1}))});
  imported.linked_files = {{"/a", std::string(64, 'a')}, {"/b", std::string(64, 'b')}};
  std::string bytes;
  write_answer(imported, [&](const void* data, std::size_t n) { bytes.append(static_cast<const char*>(data), n); });
  const auto linked = linked_files_in(bytes);
  ASSERT_TRUE(linked && linked->size() == 2);
  EXPECT_EQ((*linked)[1].file, "/b");
  EXPECT_EQ((*linked)[1].sha256, std::string(64, 'b'));
  const std::optional<Assembly> assembly = assembly_in(bytes);
  ASSERT_TRUE(assembly && assembly->components.size() == 1);
  EXPECT_EQ(assembly->components[0].name, "box");
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(linked_files_in(bytes.substr(0, size)) && assembly_in(bytes.substr(0, size))) << size;
}

TEST(ReaderProgram, IsFoundAndItsAbsenceIsSaid) {
  EXPECT_FALSE(find_reader(ReaderProgram::Meshes).empty());
  EXPECT_FALSE(find_reader(ReaderProgram::Cad).empty());
  const ScratchFolder folder;
  folder.put("dismantle-read", "no program");
  std::filesystem::permissions(folder / "dismantle-read", std::filesystem::perms::owner_all);
  const auto mesh = folder.put("a.stl", "solid a\nendsolid a\n");
  setenv("DISMANTLE_READERS", (folder / ".").c_str(), 1);
  const Result<Assembly> assembly = load_assembly(mesh);
  unsetenv("DISMANTLE_READERS");
  ASSERT_FALSE(assembly.ok());
  EXPECT_EQ(assembly.error().kind, ErrorKind::Failed);
  EXPECT_NE(assembly.error().message.find("the system gave no process"), std::string::npos);
}

}  // namespace
}  // namespace dismantle
