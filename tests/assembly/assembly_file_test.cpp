// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_file.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace dismantle {
namespace {

AssemblyFile box_in_tube() {
  AssemblyFile file;
  file.assembly = scenes::assembly({scenes::component("box", scenes::box({0, 0, 0}, {1, 2, 3})),
                                    scenes::component("tube", scenes::tube(5, 3, 0, 10, 12))});
  file.assembly.components[1].assembly_from_mesh.translation = {0.1, -7, 1e3};
  Motion motion;
  motion.response = ResponseKind::Touch;
  motion.moves.push_back({{"box", "tube"}, {{0.5, {{1, 2, 3}, quat_about({0, 0, 1}, 0.3)}}, {1.5, {}}}});
  file.motion = motion;
  return file;
}

Span<const std::byte> span_of(const std::string& bytes) {
  return {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
}

std::string bytes_of(const AssemblyFile& file) {
  return assembly_file_bytes(file.assembly, file.motion ? &*file.motion : nullptr);
}

TEST(AssemblyFile, KeepsTheAssemblyAndItsMotion) {
  const AssemblyFile written = box_in_tube();
  const Result<AssemblyFile> read = parse_assembly_file(span_of(bytes_of(written)), "a.dasm");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->motion, written.motion);
  ASSERT_EQ(read->assembly.components.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read->assembly.components[i].name, written.assembly.components[i].name);
    EXPECT_EQ(*read->assembly.components[i].mesh, *written.assembly.components[i].mesh);
    EXPECT_EQ(read->assembly.components[i].assembly_from_mesh, written.assembly.components[i].assembly_from_mesh);
  }
  const std::string without = assembly_file_bytes(written.assembly);
  EXPECT_FALSE(parse_assembly_file(span_of(without), "a.dasm")->motion);
}

TEST(AssemblyFile, RefusesEveryPrefixAndTrailingBytes) {
  std::string bytes = bytes_of(box_in_tube());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(parse_assembly_file(span_of(bytes).subspan(0, size), "a.dasm")) << size;
  bytes.push_back('\0');
  EXPECT_FALSE(parse_assembly_file(span_of(bytes), "a.dasm"));
}

TEST(AssemblyFile, RefusesWhatIsNoRigidMotionOrNoNumber) {
  const auto refused = [](const AssemblyFile& file) {
    const std::string bytes = bytes_of(file);
    const Result<AssemblyFile> read = parse_assembly_file(span_of(bytes), "a.dasm");
    return !read && read.error().kind == ErrorKind::Unreadable;
  };
  AssemblyFile scaled = box_in_tube(), mirrored = scaled, nowhere = scaled, unknown = scaled, long_turn = scaled;
  scaled.assembly.components[0].assembly_from_mesh.rotation.row[0].x = 1.001;
  mirrored.assembly.components[0].assembly_from_mesh.rotation.row[0].x = -1;
  nowhere.assembly.components[0].assembly_from_mesh.translation.y = std::nan("");
  unknown.motion->moves[0].components[1] = "ball";
  long_turn.motion->moves[0].targets[0].pose.rotation.w *= 2;
  EXPECT_FALSE(refused(box_in_tube()));
  EXPECT_TRUE(refused(scaled));
  EXPECT_TRUE(refused(mirrored));
  EXPECT_TRUE(refused(nowhere));
  EXPECT_TRUE(refused(unknown));
  EXPECT_TRUE(refused(long_turn));
}

TEST(AssemblyFile, NamesTheVersionThatItCannotRead) {
  std::string bytes = bytes_of(box_in_tube());
  bytes[8] = 9;
  const Result<AssemblyFile> read = parse_assembly_file(span_of(bytes), "a.dasm");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message,
            "a.dasm cannot be read as DASM (its version is 9, and this dismantle reads version 1); write it again with "
            "dismantle convert");
}

TEST(AssemblyFile, SurvivesChangedBytes) {
  const std::string bytes = bytes_of(box_in_tube());
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    std::string changed = bytes;
    for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<char>(random());
    const Result<AssemblyFile> read = parse_assembly_file(span_of(changed), "a.dasm");
    if (!read) continue;
    for (const Component& c : read->assembly.components)
      for (const Face& f : c.mesh->faces)
        for (const std::uint32_t v : f.v) ASSERT_LT(v, c.mesh->vertices.size());
  }
}

TEST(AssemblyFile, IsReadFromDisk) {
  const Result<AssemblyFile> read = read_assembly_file("/nonexistent/a.dasm");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace dismantle
