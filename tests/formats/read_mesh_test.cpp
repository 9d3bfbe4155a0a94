// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/sha256.h"
#include "dismantle/loading/load_assembly.h"
#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test_data.h"

#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

// Two tetrahedra.
constexpr const char* kTetrahedra =
    "mtllib colours.mtl\no tip\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
    "o tip\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\nf 5 5 6\n";

const fs::path kAssemblies = data_folder() / "assemblies";

std::string unzipped(const fs::path& file) {
  std::string bytes;
  const gzFile in = gzopen(file.c_str(), "rb");
  char buffer[65536];
  for (int n = gzread(in, buffer, sizeof buffer); n > 0; n = gzread(in, buffer, sizeof buffer))
    bytes.append(buffer, static_cast<std::size_t>(n));
  gzclose(in);
  return bytes;
}

void expect_near(const Aabb& box, const nlohmann::json& corners, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lower[axis], corners[0][static_cast<std::size_t>(axis)].get<double>(), tolerance);
    EXPECT_NEAR(box.upper[axis], corners[1][static_cast<std::size_t>(axis)].get<double>(), tolerance);
  }
}

}  // namespace

TEST(ReadMesh, MakesAnAssemblyOfAFile) {
  const ScratchFolder folder;
  folder.put("colours.mtl", "newmtl red\nKd 1 0 0\n");
  const auto assembly = load_assembly(folder.put("two.OBJ", kTetrahedra));
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  EXPECT_EQ(assembly->source_file, "two.OBJ");
  EXPECT_EQ(assembly->source_sha256, sha256(kTetrahedra));
  EXPECT_EQ(assembly->source_units, "mm");
  EXPECT_EQ(assembly->deflection, 0);
  ASSERT_EQ(assembly->components.size(), 2u);
  EXPECT_EQ(assembly->components[0].name, "tip");
  EXPECT_EQ(assembly->components[1].name, "tip#2");
  EXPECT_EQ(assembly->components[0].color, (Color{1, 0, 0, 1}));
  EXPECT_TRUE(assembly->components[0].faults.closed());
  EXPECT_EQ(assembly->components[1].faults.degenerate_faces, 1u);
  ASSERT_EQ(assembly->tree.size(), 3u);
  EXPECT_EQ(assembly->tree[0].name, "two.OBJ");
  EXPECT_EQ(assembly->tree[assembly->components[1].tree_node].name, "tip#2");
}

TEST(ReadMesh, ScalesToMillimetres) {
  const ScratchFolder folder;
  ImportOptions options;
  options.units = "in";
  const auto assembly = load_assembly(folder.put("two.obj", kTetrahedra), options);
  ASSERT_TRUE(assembly.ok());
  EXPECT_EQ(assembled_bounds(*assembly), (Aabb{{0, 0, 0}, {6 * 25.4, 25.4, 25.4}}));
  EXPECT_EQ(assembly->source_units, "in");
  options.units = "parsec";
  const auto refused = load_assembly(folder / "two.obj", options);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
}

TEST(ReadMesh, TakesAFolderInByteOrder) {
  const ScratchFolder folder;
  folder.put("set/b.obj", kTetrahedra);
  folder.put("set/B.stl",
             "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
             "endfacet\nendsolid\n");
  folder.put("set/a.b.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n");
  folder.put("set/readme.txt", "not a mesh");
  folder.put("set/deeper/c.obj", kTetrahedra);
  const auto assembly = load_assembly(folder / "set/");
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  EXPECT_EQ(assembly->source_file, "set");
  ASSERT_EQ(assembly->components.size(), 3u);
  EXPECT_EQ(assembly->components[0].name, "B");
  EXPECT_EQ(assembly->components[1].name, "a.b");
  EXPECT_EQ(assembly->components[2].name, "b");
  EXPECT_EQ(assembly->components[2].mesh->faces.size(), 8u) << "all sections of a file together";
  EXPECT_EQ(assembly->components[2].color, Color{}) << "its material file is missing";
  EXPECT_EQ(assembly->source_sha256,
            sha256(bytes_of(folder / "set/B.stl") + bytes_of(folder / "set/a.b.ply") + kTetrahedra));
}

TEST(ReadMesh, SaysWhatIsWrong) {
  const ScratchFolder folder;
  expect_unreadable(load_assembly(folder / "missing.obj"), "no such file");
  expect_unreadable(load_assembly(folder.put("empty.obj", "")), "it is empty");
  expect_unreadable(load_assembly(folder.put("text.obj", "no mesh at all\n")), "holds no component");
  expect_unreadable(load_assembly(folder.put("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
                    "holds no component");
  expect_unreadable(load_assembly(folder.put("far.obj", "v 0 0 0\nv 1 0 0\nv 2 2e9 0\nf 1 2 3\n")), "check the units");
  expect_unreadable(load_assembly(folder.put("scan.e57", "x")), "extension \".e57\"");
  expect_unreadable(load_assembly(folder.put("noext", "x")), "no file extension");
  fs::create_directory(folder / "hollow");
  expect_unreadable(load_assembly(folder / "hollow"), "holds no mesh");
  folder.put("bad/a.obj", kTetrahedra);
  folder.put("bad/b.obj", "v x\n");
  expect_unreadable(load_assembly(folder / "bad"), "b.obj cannot be read as OBJ (line 1");
}

TEST(ReadMesh, KeepsTheLimits) {
  const ScratchFolder folder;
  folder.put("set/a.obj", kTetrahedra);
  folder.put("set/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ImportOptions options;
  options.limits = {.file_bytes = 100};
  expect_unreadable(load_assembly(folder / "set", options), "more than the limit of 100");
  options.limits = {.components = 1};
  expect_unreadable(load_assembly(folder / "set/a.obj", options), "more than 1 sections");
  options.limits = {.triangles = 9};
  expect_unreadable(load_assembly(folder / "set", options), "set is too large (more than 9 triangles)");
  folder.put("pair/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.put("pair/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  options.limits = {.components = 1};
  expect_unreadable(load_assembly(folder / "pair", options), "pair is too large (more than 1 components)");
}

TEST(ReadMesh, ReportsProgressAndCanBeCancelled) {
  const ScratchFolder folder;
  folder.put("set/a.obj", kTetrahedra);
  ImportOptions options;
  int calls = 0;
  options.progress = [&calls](std::string_view, double) { return ++calls < 0; };
  const auto assembly = load_assembly(folder / "set", options);
  ASSERT_FALSE(assembly.ok());
  EXPECT_EQ(assembly.error().kind, ErrorKind::Failed);
  EXPECT_EQ(calls, 1);
}

// The parts folders of the shared data, compared with their manifests.
TEST(ReadMesh, AgreesWithTheManifestsOfRealAssemblies) {
  DISMANTLE_NEED(kAssemblies);
  for (const auto& entry : fs::directory_iterator(kAssemblies)) {
    SCOPED_TRACE(entry.path().filename());
    const auto manifest = nlohmann::json::parse(bytes_of(entry.path() / "manifest.json"));
    const auto assembly = load_assembly(entry.path() / "parts");
    ASSERT_TRUE(assembly.ok()) << message_of(assembly);
    const auto& parts = manifest["parts"];
    ASSERT_EQ(assembly->components.size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Component& component = assembly->components[i];
      EXPECT_EQ(component.name, fs::path(parts[i]["file"].get<std::string>()).stem().string());
      EXPECT_EQ(component.mesh->faces.size() + component.faults.degenerate_faces,
                parts[i]["triangles"].get<std::size_t>());
      if (component.faults.degenerate_faces == 0) {  // the manifests count edges with the degenerate triangles
        EXPECT_EQ(component.mesh->vertices.size(), parts[i]["vertices"].get<std::size_t>()) << component.name;
        EXPECT_EQ(component.faults.boundary_edges, parts[i]["boundary_edges"].get<std::size_t>()) << component.name;
        EXPECT_EQ(component.faults.nonmanifold_edges, parts[i]["nonmanifold_edges"].get<std::size_t>());
      }
      expect_near(assembled_bounds(component), parts[i]["bbox"], 1e-6);
    }
  }
}

// The originals that are meshes, in metres; the parts are the same meshes in millimetres.
TEST(ReadMesh, ReadsOriginalsInMetres) {
  DISMANTLE_NEED(kAssemblies);
  const ScratchFolder folder;
  ImportOptions options;
  options.units = "m";
  for (const char* name : {"factory_nut_bolt_m16", "factory_nut_bolt_m8_loose", "industreal_gears"}) {
    SCOPED_TRACE(name);
    for (const auto& entry : fs::directory_iterator(kAssemblies / name / "original"))
      folder.put((fs::path(name) / entry.path().stem()).string(), unzipped(entry.path()));
    const auto original = load_assembly(folder / name, options);
    const auto parts = load_assembly(kAssemblies / name / "parts");
    ASSERT_TRUE(original.ok() && parts.ok()) << message_of(original);
    ASSERT_EQ(original->components.size(), parts->components.size());
    EXPECT_EQ(triangle_count(*original), triangle_count(*parts));
    for (const Component& part : parts->components) {
      const auto id = original->find(part.name.substr(4));  // without the number before it
      ASSERT_TRUE(id.has_value()) << part.name;
      const Vec3 size = assembled_bounds((*original)[*id]).size();
      EXPECT_NEAR(length(size - assembled_bounds(part).size()), 0, 1e-5) << part.name;
      EXPECT_EQ((*original)[*id].mesh->faces.size(), part.mesh->faces.size()) << part.name;
    }
  }
}

TEST(ReadMesh, ReadsOriginalsFromStl) {
  const fs::path originals = kAssemblies / "openflexure_microscope/original";
  DISMANTLE_NEED(originals);
  const ScratchFolder folder;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(originals)) {
    if (entry.path().extension() != ".gz" || !is_regular_file(entry)) continue;
    folder.put(entry.path().stem().string(), unzipped(entry.path()));
    ++count;
  }
  const auto assembly = load_assembly(folder.path());
  ASSERT_TRUE(assembly.ok()) << message_of(assembly);
  EXPECT_EQ(assembly->components.size(), count);
  for (const Component& component : assembly->components)
    EXPECT_GT(component.mesh->faces.size(), 10u) << component.name;
}

}  // namespace dismantle
