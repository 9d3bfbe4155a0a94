// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/html_check_report.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <png.h>
#include <tinyxml2.h>

#include <string>
#include <vector>

namespace dismantle {
namespace {

constexpr const char* kHostileName = "<script>alert(1)</script>\"onload='x' & \xFF";

Assembly press_fit() {
  Assembly a = scenes::assembly({scenes::component("plate", scenes::tube(10, 3, 0, 4, 24)),
                                 scenes::component(kHostileName, scenes::tube(3.1, 0, -1, 6, 24)),
                                 scenes::component("lid", scenes::box({-10, -10, 4}, {10, 10, 5})),
                                 scenes::component("foot", scenes::box({-10, -10, -3}, {10, 10, -1.5}))});
  a.source_file = "press <fit>.step";
  return a;
}

Clashes clashes_of_press_fit() {
  const auto id = [](std::uint32_t i) { return ComponentId(i); };
  return {0.01,
          {{id(0), id(1), ClashState::Overlapping, {}, 0, 0.1, 0.1, {3, 0, 2}, 8, 0.05, false},
           {id(0), id(2), ClashState::Contact, {}, 0, 0, 0, {0, 5, 4}, 0, 0, false},
           {id(1), id(2), ClashState::Overlapping, id(1), 0, 1, 0.99, {0, 0, 5}, 30, 0.2, false},
           {id(1), id(3), ClashState::Near, {}, 0.5, 0, 0, {0, 0, -1}, 0, 0, false}}};
}

std::string report_of(const Assembly& assembly, const Clashes& clashes, HtmlCheckOptions options = {}) {
  options.picture_width = 96;
  options.picture_height = 72;
  Result<std::string> html = html_check_report(assembly, clashes, options);
  EXPECT_TRUE(html.ok());
  return html.ok() ? *html : std::string();
}

/// All elements of a document, depth first.
std::vector<const tinyxml2::XMLElement*> elements_of(const tinyxml2::XMLDocument& document) {
  std::vector<const tinyxml2::XMLElement*> elements;
  for (const auto* e = document.RootElement(); e != nullptr; e = e->NextSiblingElement()) elements.push_back(e);
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const auto* e = elements[i]->FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      elements.push_back(e);
  return elements;
}

std::vector<std::uint8_t> bytes_of_base64(std::string_view text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

TEST(HtmlCheckReport, IsWellFormedAndShowsEveryPair) {
  const std::string html = report_of(press_fit(), clashes_of_press_fit());
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(html.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  int rows = 0, pictures = 0;
  for (const auto* e : elements_of(document)) {
    rows += std::string_view(e->Name()) == "tr" ? 1 : 0;
    pictures += std::string_view(e->Name()) == "img" ? 1 : 0;
  }
  EXPECT_EQ(rows, 1 + 4);
  EXPECT_EQ(pictures, 2 + 2) << "two overviews, the overlapping pairs";
}

TEST(HtmlCheckReport, LoadsNothingFromAnywhere) {
  const std::string html = report_of(press_fit(), clashes_of_press_fit());
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(html.c_str()), tinyxml2::XML_SUCCESS);
  for (const auto* e : elements_of(document)) {
    const std::string_view name = e->Name();
    EXPECT_TRUE(name != "link" && name != "iframe" && name != "object" && name != "base") << name;
    const char* source = e->Attribute("src");
    EXPECT_TRUE(source == nullptr || std::string(source).rfind("data:image/png;base64,", 0) == 0) << source;
    const char* target = e->Attribute("href");
    EXPECT_TRUE(target == nullptr || target[0] == '#') << target;
  }
  for (const char* word : {"http:", "https:", "url(", "@import", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST(HtmlCheckReport, NamesAreTextWhateverTheyContain) {
  const std::string html = report_of(press_fit(), clashes_of_press_fit());
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(1)&lt;/script&gt;&quot;onload=&#39;x&#39; &amp; \xEF\xBF\xBD"),
            std::string::npos);
  EXPECT_NE(html.find("<title>Clash report: press &lt;fit&gt;.step</title>"), std::string::npos);
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(html.c_str()), tinyxml2::XML_SUCCESS);
  int scripts = 0;
  for (const auto* e : elements_of(document)) {
    scripts += std::string_view(e->Name()) == "script" ? 1 : 0;
    EXPECT_EQ(e->Attribute("onload"), nullptr);
  }
  EXPECT_EQ(scripts, 1);
}

TEST(HtmlCheckReport, PicturesArePngOfTheRequestedSize) {
  const std::string html = report_of(press_fit(), clashes_of_press_fit());
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(html.c_str()), tinyxml2::XML_SUCCESS);
  for (const auto* e : elements_of(document)) {
    if (std::string_view(e->Name()) != "img") continue;
    const std::string source = e->Attribute("src");
    const std::vector<std::uint8_t> png = bytes_of_base64(std::string_view(source).substr(source.find(',') + 1));
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&header, png.data(), png.size()), 0);
    EXPECT_EQ(header.width, 96u);
    EXPECT_EQ(header.height, 72u);
    png_image_free(&header);
  }
}

TEST(HtmlCheckReport, LimitsTheNumberOfCloseups) {
  HtmlCheckOptions options;
  options.pictures = 1;
  const std::string html = report_of(press_fit(), clashes_of_press_fit(), options);
  EXPECT_NE(html.find("id=\"pair-1\""), std::string::npos);
  EXPECT_EQ(html.find("pair-2\""), std::string::npos);
}

TEST(HtmlCheckReport, IsAPageWithoutPairsToo) {
  const std::string html = report_of(press_fit(), {0.01, {}});
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(html.c_str()), tinyxml2::XML_SUCCESS);
  EXPECT_EQ(html.find("Overlaps, worst first"), std::string::npos);
}

TEST(HtmlCheckReport, HasTheSameBytesOnEveryExecutor) {
  HtmlCheckOptions threads;
  threads.executor = Executor(ExecutorKind::Threads, 3);
  EXPECT_EQ(report_of(press_fit(), clashes_of_press_fit(), threads), report_of(press_fit(), clashes_of_press_fit()));
}

TEST(HtmlCheckReport, CanBeCancelled) {
  HtmlCheckOptions options;
  options.progress = [](std::string_view, double fraction) { return fraction < 0.5; };
  const Result<std::string> html = html_check_report(press_fit(), clashes_of_press_fit(), options);
  ASSERT_FALSE(html.ok());
  EXPECT_EQ(html.error().kind, ErrorKind::Failed);
}

}  // namespace
}  // namespace dismantle
