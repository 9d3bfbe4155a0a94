// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/referenced_file.h"

#include "dismantle/loading/load_assembly.h"
#include "tests/formats/gltf_files.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace dismantle {
namespace {

namespace fs = std::filesystem;

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

TEST(ReferencedFile, FindsWhatIsInTheFolders) {
  const ScratchFolder folder;
  folder.put("model/parts/a.obj", kTriangle);
  folder.put("other/b.obj", kTriangle);
  const fs::path base = folder / "model";
  const std::vector<fs::path> folders = {fs::canonical(base), fs::canonical(folder / "other")};
  const auto find = [&](const fs::path& address) { return referenced_file(address, base, folders); };
  EXPECT_TRUE(find("parts/a.obj").ok());
  EXPECT_TRUE(find("parts/../parts/./a.obj").ok());
  EXPECT_TRUE(find("../other/b.obj").ok());
  EXPECT_TRUE(find(folders[1] / "b.obj").ok());
}

TEST(ReferencedFile, RefusesWhatLeadsOut) {
  const ScratchFolder folder;
  folder.put("secret.obj", kTriangle);
  folder.put("model/a.obj", kTriangle);
  folder.put("models/c.obj", kTriangle);  // its name begins with that of the folder
  fs::create_symlink(folder / "secret.obj", folder / "model" / "link.obj");
  fs::create_directory_symlink(folder / "models", folder / "model" / "folder");
  fs::create_symlink("a.obj", folder / "model" / "inside.obj");
  const fs::path base = folder / "model";
  const std::vector<fs::path> folders = {fs::canonical(base)};
  const auto why_not = [&](const fs::path& address) {
    const Result<fs::path> found = referenced_file(address, base, folders);
    return found ? std::string() : found.error().message;
  };
  for (const char* address : {"../secret.obj", "/etc/hostname", "x/../../secret.obj", "..", "../models/c.obj"})
    EXPECT_NE(why_not(address).find("is not in its folder"), std::string::npos) << address << why_not(address);
  for (const char* address : {"link.obj", "folder/c.obj", "inside.obj"})
    EXPECT_NE(why_not(address).find("is reached through a symbolic link"), std::string::npos) << address;
  EXPECT_NE(why_not("none.obj").find("not there"), std::string::npos);
  EXPECT_NE(why_not(fs::path(std::string("a.obj\0.stl", 10))).find("no file name"), std::string::npos);
  EXPECT_EQ(why_not("a.obj"), "");
}

TEST(ReferencedFile, TakesALinkThatTheUserNamed) {
  const ScratchFolder folder;
  folder.put("model/a.obj", kTriangle);
  fs::create_directory_symlink(folder / "model", folder / "named");
  EXPECT_TRUE(load_assembly(folder / "named" / "a.obj").ok());
  const std::vector<fs::path> folders = reference_folders(folder / "named" / "a.obj", {});
  EXPECT_TRUE(referenced_file("a.obj", folder / "named", folders).ok());
}

TEST(ReferencedFile, AGltfReadsOnlyWhatBelongsToIt) {
  const ScratchFolder folder;
  folder.put("tetrahedron.bin", tetrahedron_bytes());
  folder.put("model/tetrahedron.bin", tetrahedron_bytes());
  const auto load = [&](const std::string& uri, const ImportOptions& options = {}) {
    return load_assembly(folder.put("model/a.gltf", tetrahedron_json("{\"mesh\": 0}", "",
                                                                     R"({"byteLength": 72, "uri": ")" + uri + "\"}")),
                         options);
  };
  EXPECT_TRUE(load("tetrahedron.bin").ok());
  EXPECT_TRUE(load("%74etrahedron.bin").ok());
  for (const char* uri : {"../tetrahedron.bin", "%2e%2e/tetrahedron.bin", "..%2Ftetrahedron.bin", "%2Fetc%2Fhostname"})
    expect_unreadable(load(uri), "is not in its folder");
  expect_unreadable(load("file:///etc/hostname"), "nothing is fetched from elsewhere");
  ImportOptions options;
  options.reference_folders = {folder / "."};
  EXPECT_TRUE(load("../tetrahedron.bin", options).ok());
}

}  // namespace
}  // namespace dismantle
