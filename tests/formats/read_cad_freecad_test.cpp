// SPDX-License-Identifier: Apache-2.0
// The files in freecad/ were written by FreeCAD 0.20; boxes and volumes are what it says of them.
#include "dismantle/files/zip_archive.h"
#include "dismantle/loading/load_assembly.h"

#include "tests/support/scratch_folder.h"
#include "tests/support/test_data.h"
#include "tests/support/zip_writer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace dismantle {
namespace {

const std::filesystem::path kFiles = std::filesystem::path(DISMANTLE_SOURCE_DIR) / "tests/formats/freecad";

struct Expected {
  std::string name, parent;
  double volume;
  Vec3 lower, upper;
};

void expect_components(const std::filesystem::path& file, const std::vector<Expected>& all) {
  const Result<Assembly> a = load_assembly(file, {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  ASSERT_EQ(a->components.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Component& c = a->components[i];
    EXPECT_EQ(c.name, all[i].name);
    EXPECT_EQ(a->tree[a->tree[c.tree_node].parent].name, all[i].parent) << c.name;
    EXPECT_TRUE(c.faults.bounds_solid()) << c.name;
    EXPECT_NEAR(signed_volume(*c.mesh), all[i].volume, 2e-3 * all[i].volume) << c.name;
    const Aabb box = assembled_bounds(c);
    EXPECT_LT(max_abs(box.lower - all[i].lower), 0.01) << c.name;
    EXPECT_LT(max_abs(box.upper - all[i].upper), 0.01) << c.name;
  }
}

TEST(ReadCadFreeCad, ShowsWhatIsVisibleAndNotMadeIntoAnotherFeature) {
  // A cut of a box and a cylinder, a pin in a part of its own, a ball in a group; all in a part turned by 90 degrees.
  // The cut's inputs are visible in the file; another box is hidden.
  expect_components(kFiles / "clamp.FCStd", {{"block", "Klammer \xc3\xbc", 1717.26, {90, 0, 0}, {100, 20, 10}},
                                             {"pin", "pins", 1130.97, {92, 7, -10}, {98, 13, 30}},
                                             {"Ball", "Group", 268.08, {96, 46, -4}, {104, 54, 4}}});
}

TEST(ReadCadFreeCad, PlacesLinksAndArraysOfABody) {
  expect_components(kFiles / "links.FCStd", {{"bracket", "links", 349.73, {0, 0, 100}, {10, 10, 104}},
                                             {"second", "links", 349.73, {20, 0, 0}, {30, 10, 4}},
                                             {"row_i0", "row", 349.73, {0, 50, 0}, {10, 60, 4}},
                                             {"row_i1", "row", 349.73, {0, 70, 0}, {10, 80, 4}},
                                             {"row_i2", "row", 349.73, {0, 90, 0}, {10, 100, 4}},
                                             {"Array2_i0", "seen", 349.73, {60, 0, 100}, {70, 10, 104}},
                                             {"Array2_i1", "seen", 349.73, {60, 0, 130}, {70, 10, 134}},
                                             {"large", "links", 2797.88, {100, 0, 0}, {120, 20, 8}}});
  const Result<Assembly> a = load_assembly(kFiles / "links.FCStd", {});
  ASSERT_TRUE(a.ok());
  EXPECT_EQ(a->components[0].mesh, a->components[6].mesh);
}

TEST(ReadCadFreeCad, ReadsOtherDocumentsAndMirroredShapes) {
  expect_components(kFiles / "external.FCStd", {{"bolt", "Bolt0", 251.33, {-2, -2, 0}, {2, 2, 20}},
                                                {"bolt#2", "Bolt1", 251.33, {18, -2, 0}, {22, 2, 20}},
                                                {"mirrored", "external", 653.33, {-10, 0, 0}, {0, 10, 10}},
                                                {"Wedge", "external", 653.33, {0, 0, 0}, {10, 10, 10}},
                                                {"Comp", "Comp", 1000, {0, 50, 0}, {10, 60, 10}},
                                                {"Comp#2", "Comp", 1000, {20, 50, 0}, {30, 60, 10}}});
}

TEST(ReadCadFreeCad, ReadsAChangedLinkedDocumentAnew) {
  const ScratchFolder folder;
  std::filesystem::copy(kFiles, folder / "all", std::filesystem::copy_options::recursive);
  ImportOptions options;
  options.cache_folder = folder / "cache";
  const Result<Assembly> first = load_assembly(folder / "all/external.FCStd", options);
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(load_assembly(folder / "all/external.FCStd", options)->source_sha256, first->source_sha256);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(options.cache_folder), {}), 1);

  std::filesystem::remove(folder / "all/parts/bolt.FCStd");
  const Result<Assembly> missing = load_assembly(folder / "all/external.FCStd", options);
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("its link \"Bolt0\" leads to \"parts/bolt.FCStd\""), std::string::npos)
      << missing.error().message;
  EXPECT_NE(missing.error().message.find("it is not there"), std::string::npos) << missing.error().message;
}

/// An object's entry in ObjectData.
std::string object(const std::string& name, const std::string& properties) {
  return "<Object name='" + name + "'><Properties>" + properties + "</Properties></Object>";
}

std::string link_to(const std::string& name, const std::string& file = "") {
  return "<Property name='LinkedObject' type='App::PropertyXLink'><XLink file='" + file + "' name='" + name +
         "'/></Property>";
}

std::string group_of(const std::string& name) {
  return "<Property name='Group' type='App::PropertyLinkList'><LinkList count='1'><Link value='" + name +
         "'/></LinkList></Property>";
}

const std::string kShape = "<Property name='Shape' type='Part::PropertyPartShape'><Part file='s.brp'/></Property>";

/// The message for a document of these objects, "name:type" each, and their data.
std::string error_of(const std::vector<std::pair<std::string, std::string>>& objects, const std::string& data,
                     const std::string& brep = "") {
  std::string xml = "<?xml version='1.0' encoding='utf-8'?><Document SchemaVersion='4'><Objects>";
  for (const auto& [name, type] : objects) xml += "<Object type='" + type + "' name='" + name + "'/>";
  xml += "</Objects><ObjectData>" + data + "</ObjectData></Document>";
  const ScratchFolder folder;
  write_zip(folder / "a.FCStd", {{"Document.xml", xml}, {"s.brp", brep}});
  const Result<Assembly> a = load_assembly(folder / "a.FCStd", {});
  if (a) return {};
  EXPECT_EQ(a.error().message.find('\n'), std::string::npos);
  return a.error().message;
}

void expect_in(const std::string& error, const std::string& why) {
  EXPECT_NE(error.find(why), std::string::npos) << error;
}

TEST(ReadCadFreeCad, SaysWhatIsWrongWithADocument) {
  expect_in(error_of({}, ""), "no solid and no surface");
  expect_in(error_of({{"A", "Part::Box"}}, object("A", kShape), "no BREP"), "the shape of its object \"A\"");
  expect_in(error_of({{"A", "Part::Box"}}, object("A", "<Property name='Shape'><Part file='t.brp'/></Property>")),
            "\"t.brp\" is missing");
  expect_in(error_of({{"A", "Part::Box"}},
                     object("A", kShape + "<Property name='Placement'><P Px='nan' Q3='1'/></Property>")),
            "a number of its object \"A\" is not finite");
  expect_in(error_of({{"L", "App::Link"}}, object("L", link_to("Nobody"))), "its link \"L\" leads to no object");
  expect_in(error_of({{"L", "App::Link"}}, object("L", link_to("A", "no.FCStd"))),
            "\"no.FCStd\", which cannot be read");

  const ScratchFolder folder;
  const auto error_of_bytes = [&](std::string_view bytes) {
    return load_assembly(folder.put("b.FCStd", bytes), {}).error().message;
  };
  expect_in(error_of_bytes("no archive"), "no zip archive");
  const std::string whole = bytes_of(kFiles / "links.FCStd");
  expect_in(error_of_bytes(whole.substr(0, whole.size() / 2)), "no zip archive");
  write_zip(folder / "c.FCStd", {{"other", "x"}});
  expect_in(load_assembly(folder / "c.FCStd", {}).error().message, "\"Document.xml\" is missing");
  write_zip(folder / "d.FCStd", {{"Document.xml", std::string(300 << 20, ' ')}});
  expect_in(load_assembly(folder / "d.FCStd", {}).error().message, "unpacks to more than");
}

TEST(ReadCadFreeCad, RefusesLinksAndGroupsInACircle) {
  expect_in(error_of({{"A", "App::Link"}, {"B", "App::Link"}}, object("A", link_to("B")) + object("B", link_to("A"))),
            "links to itself");
  expect_in(error_of({{"A", "App::Part"}, {"L", "App::Link"}}, object("A", group_of("L")) + object("L", link_to("A"))),
            "links to itself");
  expect_in(error_of({{"A", "App::Link"}}, object("A", link_to("A", "a.FCStd"))), "links to itself");
}

TEST(ReadCadFreeCad, RefusesArraysThatExplode) {
  std::vector<std::pair<std::string, std::string>> objects{{"A0", "Part::Box"}};
  std::string data = object("A0", kShape);
  for (int i = 1; i < 12; ++i) {
    const std::string name = "A" + std::to_string(i);
    objects.push_back({name, "App::Link"});
    data += object(name, link_to("A" + std::to_string(i - 1)) +
                             "<Property name='ElementCount'><Integer value='1000'/></Property>");
  }
  expect_in(error_of(objects, data, "CASCADE Topology V1\n"), "");
  EXPECT_NE(error_of(objects, data, "CASCADE Topology V1\n"), "");
}

/// The volumes of a data set's manifest, which FreeCAD's own shapes gave, meshed coarsely.
TEST(FreeCadData, AgreesWithTheManifest) {
  const std::filesystem::path folder = data_folder() / "assemblies/asm4_v4_engine";
  DISMANTLE_NEED(folder);
  const auto manifest = nlohmann::json::parse(std::ifstream(folder / "manifest.json"));
  const Result<Assembly> a = load_assembly(folder / "original/asm_V4.FCStd", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  std::vector<double> expected, found;
  for (const auto& part : manifest["parts"]) expected.push_back(part["volume"]);
  for (const Component& c : a->components) found.push_back(signed_volume(*c.mesh));
  ASSERT_EQ(found.size(), expected.size());
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 0.02 * expected[i]);
}

TEST(FreeCadData, ReadsAnAssemblyOfHundredsOfLinks) {
  const std::filesystem::path folder = data_folder() / "assemblies/lego_garden/original";
  DISMANTLE_NEED(folder);
  const ScratchFolder scratch;
  const std::string bytes = bytes_of(folder / "asm_LegoHouse.zip");
  Result<ZipArchive> archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive.ok());
  for (const std::string& name : archive->names())
    if (!name.ends_with('/')) scratch.put(name, *archive->read(name));
  const Result<Assembly> a = load_assembly(scratch / "asm_LegoHouse/asm_Garden.fcstd", {});
  ASSERT_TRUE(a.ok()) << a.error().message;
  EXPECT_EQ(a->components.size(), 297u);
  EXPECT_LT(max_abs(assembled_bounds(*a).lower - Vec3{-328.174, -199, -2}), 0.01);
}

}  // namespace
}  // namespace dismantle
