// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/html_text.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

std::string base64_of(std::string_view text) {
  return base64(Span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

TEST(HtmlEscaped, LeavesNothingThatStartsATagOrEndsAnAttribute) {
  EXPECT_EQ(html_escaped("<script>alert('x' + \"y\") & z</script>"),
            "&lt;script&gt;alert(&#39;x&#39; + &quot;y&quot;) &amp; z&lt;/script&gt;");
}

TEST(HtmlEscaped, KeepsUtf8AndReplacesWhatIsNone) {
  EXPECT_EQ(html_escaped("Büchse \xE2\x82\xAC \xF0\x9F\x94\xA9"), "Büchse \xE2\x82\xAC \xF0\x9F\x94\xA9");
  EXPECT_EQ(html_escaped("a\xFFz"), "a\xEF\xBF\xBDz");
  EXPECT_EQ(html_escaped("\xC3"), "\xEF\xBF\xBD");                                  // cut off
  EXPECT_EQ(html_escaped("\xC0\xBC"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // '<' in two bytes
  EXPECT_EQ(html_escaped("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(html_escaped(std::string_view("a\0b\x1B\n", 5)), "a b  ");
}

TEST(Base64, IsAsTheRfcHasIt) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xFB\xFF\xFE"), "+//+");
}

}  // namespace
}  // namespace dismantle
