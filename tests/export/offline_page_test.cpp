// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/offline_page.h"

#include "tests/export/export_scene.h"

#include <gtest/gtest.h>
#include <zlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dismantle {
namespace {

using Json = nlohmann::json;

const ViewerFiles kFiles{"const end = '</script>', note = '<!--';", "body { color: red }", "p { margin: 0 }", "<svg/>"};

/// The content of a block of the page.
std::string block(const std::string& page, const std::string& id) {
  const std::size_t begin = page.find('>', page.find("id=\"" + id + "\"")) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

std::string decoded(const std::string& base64) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(kDigits.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

std::string inflated(const std::string& packed) {
  std::string bytes(1 << 20, '\0');
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()),
            Z_OK);
  bytes.resize(length);
  return bytes;
}

std::string page_of(const Assembly& assembly, const Path& path, const OfflinePageOptions& options = {}) {
  const Result<std::string> page = offline_page(assembly, path, kFiles, options);
  EXPECT_TRUE(page.ok());
  return page.ok() ? *page : std::string();
}

TEST(OfflinePage, ContainsTheModelAndThePath) {
  const Assembly a = scenes::knob_on_block();
  const std::string page = page_of(a, scenes::knob_path());
  EXPECT_EQ(inflated(decoded(block(page, "offline-model"))), *glb_from_assembly(a));
  const Json path = Json::parse(block(page, "offline-path"));
  ASSERT_EQ(path["moves"].size(), 3u);
  EXPECT_EQ(path["moves"][0]["frames"][2]["position"], Json::array({0.0, 0.0, 30.0}));
  const Json model = Json::parse(block(page, "offline-assembly"));
  EXPECT_EQ(model["components"].size(), 3u);
  EXPECT_EQ(model["components"][1]["name"], "block");
  EXPECT_EQ(model["components"][1]["bounds"], Json::parse("[[-10, -10, 0], [10, 10, 20]]"));
  EXPECT_EQ(model["triangles"], triangle_count(a));
}

TEST(OfflinePage, BeginsDisassembledIfReversed) {
  OfflinePageOptions options;
  options.direction = PathDirection::Reversed;
  const Json path = Json::parse(block(page_of(scenes::knob_on_block(), scenes::knob_path(), options), "offline-path"));
  EXPECT_EQ(path["moves"][0]["label"], "block aside");
  EXPECT_EQ(path["moves"][0]["frames"][0]["position"], Json::array({0.0, 60.0, 0.0}));
  EXPECT_EQ(path["moves"][2]["frames"].back()["position"], Json::array({0.0, 0.0, 0.0}));
}

TEST(OfflinePage, EscapesComponentNames) {
  Assembly a = scenes::knob_on_block();
  a.components[1].name = "</script><script>alert(1)</script>";
  a.source_file = "<img src=x>.step";
  Path path = scenes::knob_path();
  path.components[1] = a.components[1].name;
  path.moves[2].components = {a.components[1].name};
  path.moves[2].label = "<!-- move";
  const std::string page = page_of(a, path);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_EQ(Json::parse(block(page, "offline-assembly"))["components"][1]["name"], a.components[1].name);
  EXPECT_EQ(Json::parse(block(page, "offline-path"))["moves"][2]["label"], "<!-- move");
}

TEST(OfflinePage, ContainsItsScriptUnchanged) {
  const std::string page = page_of(scenes::knob_on_block(), scenes::knob_path());
  EXPECT_NE(page.find("const end = '<\\/script>', note = '<\\!--';</script>"), std::string::npos);
}

TEST(OfflinePage, ForbidsLoadingAnything) {
  const std::string page = page_of(scenes::knob_on_block(), scenes::knob_path());
  EXPECT_NE(page.find("default-src 'none'; script-src 'unsafe-inline'"), std::string::npos);
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
}

TEST(OfflinePage, CanBeMadeOfAnAssemblyAlone) {
  const std::string page = page_of(scenes::knob_on_block(), {});
  EXPECT_TRUE(Json::parse(block(page, "offline-path"))["moves"].empty());
  EXPECT_GT(Json::parse(block(page, "offline-assembly"))["tolerance"].get<double>(), 0);
}

TEST(OfflinePage, IsNotMadeIfCancelled) {
  OfflinePageOptions options;
  options.progress = [](std::string_view, double) { return false; };
  const Result<std::string> page = offline_page(scenes::knob_on_block(), scenes::knob_path(), kFiles, options);
  ASSERT_FALSE(page.ok());
  EXPECT_EQ(page.error().kind, ErrorKind::Failed);
}

}  // namespace
}  // namespace dismantle
