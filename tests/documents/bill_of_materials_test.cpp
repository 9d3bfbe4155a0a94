// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/bill_of_materials.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace dismantle {
namespace {

Component pin(std::string name, double at) {
  Component c = scenes::component(std::move(name), scenes::box({0, 0, 0}, {2, 3, 10}));
  c.assembly_from_mesh.translation = {at, 0, 0};
  return c;
}

/// A plate and three pins, two of which are instances of one mesh, the third an equal mesh of its own; the last pin is
/// red.
Assembly pinned() {
  Component open = scenes::component("sheet, \"thin\"", scenes::box({0, 0, 0}, {1, 1, 1}));
  TriangleMesh mesh = *open.mesh;
  mesh.faces.pop_back();
  CleanedMesh cleaned = clean_mesh(mesh);
  open.mesh = std::make_shared<const TriangleMesh>(cleaned.mesh);
  open.faults = cleaned.faults;
  Component first = pin("pin", 0), second = pin("pin#2", 20), third = pin("pin#3", 40), red = pin("pin#4", 60);
  second.mesh = first.mesh;
  red.color = {1, 0, 0, 0.5f};
  Assembly a = scenes::assembly({first, open, second, third, red});
  a.tree = {{"vice", 0}, {"jaw", 0}, {"pin", 1}};
  a.components[0].tree_node = 2;
  for (std::size_t i = 1; i < 5; ++i) a.components[i].tree_node = 1;
  return a;
}

TEST(BillOfMaterials, CountsEqualShapesOfOneColourInOneRow) {
  const std::vector<BillItem> bill = bill_of_materials(pinned());
  ASSERT_EQ(bill.size(), 3u);
  EXPECT_EQ(bill[0].name, "pin");
  EXPECT_EQ(bill[0].components, (std::vector<ComponentId>{ComponentId(0), ComponentId(2), ComponentId(3)}));
  EXPECT_EQ(bill[1].name, "sheet, \"thin\"");
  EXPECT_EQ(bill[2].components, (std::vector<ComponentId>{ComponentId(4)}));
}

TEST(BillOfMaterials, MeasuresTheShape) {
  const std::vector<BillItem> bill = bill_of_materials(pinned());
  EXPECT_EQ(bill[0].size, (Vec3{2, 3, 10}));
  ASSERT_TRUE(bill[0].volume.has_value());
  EXPECT_NEAR(*bill[0].volume, 60, 1e-12);
  EXPECT_NEAR(bill[0].area, 2 * (6 + 20 + 30), 1e-12);
  EXPECT_EQ(bill[0].triangles, 12u);
  EXPECT_FALSE(bill[1].volume.has_value()) << "an open surface encloses nothing";
}

TEST(BillOfMaterials, GivesThePlacesOfComponentsInTheTree) {
  const std::vector<BillItem> bill = bill_of_materials(pinned());
  EXPECT_EQ(bill[0].places, (std::vector<std::string>{"jaw/pin", "jaw/pin#2", "jaw/pin#3"}));
}

TEST(BillOfMaterials, IsATableThatSpreadsheetsRead) {
  const Assembly a = pinned();
  const std::string csv = bill_csv(a, bill_of_materials(a));
  EXPECT_NE(csv.find("\r\n1,pin,3,,,,2,3,10,60,112,12,#b3b3b8,pin; pin#2; pin#3,jaw/pin; jaw/pin#2; jaw/pin#3\r\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("\r\n2,\"sheet, \"\"thin\"\"\",1,,,,1,1,1,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",#ff000080,pin#4,"), std::string::npos) << csv;
}

TEST(BillOfMaterials, IsJsonThatProgramsRead) {
  const Assembly a = pinned();
  const nlohmann::json json = nlohmann::json::parse(bill_json(a, bill_of_materials(a)));
  EXPECT_EQ(json["format"], "dismantle-bill");
  EXPECT_EQ(json["assembly"]["components"], 5);
  ASSERT_EQ(json["items"].size(), 3u);
  EXPECT_EQ(json["items"][0]["count"], 3);
  EXPECT_NEAR(json["items"][0]["volume_mm3"].get<double>(), 60, 1e-12);
  EXPECT_TRUE(json["items"][1]["volume_mm3"].is_null());
  EXPECT_EQ(json["items"][2]["components"], nlohmann::json::array({"pin#4"}));
}

TEST(BillOfMaterials, NamesFastenersAndTheirTools) {
  const Assembly a = scenes::assembly({scenes::component("part", scenes::tube(4, 0, 0, 20, 48)),
                                       scenes::component("washer M5", scenes::tube(5, 2.65, 0, 1, 48))});
  const std::string csv = bill_csv(a, bill_of_materials(a));
  EXPECT_NE(csv.find("\r\n1,part,1,dowel,8x20,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\r\n2,washer M5,1,washer,M5,,"), std::string::npos) << csv;
  const nlohmann::json json = nlohmann::json::parse(bill_json(a, bill_of_materials(a)));
  EXPECT_EQ(json["items"][0]["fastener"]["kind"], "dowel");
  EXPECT_EQ(json["items"][0]["fastener"]["diameter_mm"], 8);
  EXPECT_EQ(json["items"][1]["fastener"]["designation"], "M5");
}

TEST(BillOfMaterials, IsEmptyForAnEmptyAssembly) {
  EXPECT_TRUE(bill_of_materials(Assembly{}).empty());
  EXPECT_TRUE(nlohmann::json::parse(bill_json({}, {}))["items"].empty());
}

}  // namespace
}  // namespace dismantle
