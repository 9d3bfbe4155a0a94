// SPDX-License-Identifier: Apache-2.0
#include "apps/server/access_rules.h"

#include <gtest/gtest.h>

#include <set>

namespace dismantle::server {
namespace {

const std::string kToken = "00112233445566778899aabbccddeeff";

TEST(AccessRules, MakesTokensOf128BitsThatDiffer) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string token = random_token();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    seen.insert(token);
  }
  EXPECT_EQ(seen.size(), 1000u);
}

TEST(AccessRules, KnowsOnlyItsOwnLiteralsAsHost) {
  const AccessRules rules(8123, kToken);
  for (const char* own : {"127.0.0.1:8123", "localhost:8123", "[::1]:8123"}) EXPECT_TRUE(rules.is_own_host(own)) << own;
  for (const char* other :
       {"", "127.0.0.1", "127.0.0.1:8124", "127.0.0.1:81230", "127.0.0.2:8123", "localhost.:8123", "LOCALHOST:8123",
        "evil.com:8123", "localhost:8123.evil.com", "::1:8123", " localhost:8123", "0.0.0.0:8123", "127.1:8123"})
    EXPECT_FALSE(rules.is_own_host(other)) << other;
}

TEST(AccessRules, KnowsOnlyItsOwnLiteralsAsOrigin) {
  const AccessRules rules(8123, kToken);
  EXPECT_TRUE(rules.is_own_origin("http://127.0.0.1:8123"));
  EXPECT_TRUE(rules.is_own_origin("http://[::1]:8123"));
  for (const char* other : {"", "null", "https://127.0.0.1:8123", "http://127.0.0.1", "127.0.0.1:8123",
                            "http://127.0.0.1:8123/", "http://evil.com", "http://evil.com:8123", "file://"})
    EXPECT_FALSE(rules.is_own_origin(other)) << other;
}

TEST(AccessRules, LetsInOnlyWithTheWholeToken) {
  const AccessRules rules(8123, kToken);
  EXPECT_TRUE(rules.is_authorized("Bearer " + kToken));
  EXPECT_FALSE(rules.is_authorized(""));
  EXPECT_FALSE(rules.is_authorized("Bearer "));
  EXPECT_FALSE(rules.is_authorized("bearer " + kToken));
  EXPECT_FALSE(rules.is_authorized("Bearer " + kToken + "0"));
  for (std::size_t i = 0; i < kToken.size(); ++i) {
    std::string wrong = kToken;
    wrong[i] = wrong[i] == '0' ? '1' : '0';
    EXPECT_FALSE(rules.is_authorized("Bearer " + wrong));
    EXPECT_FALSE(rules.is_authorized("Bearer " + kToken.substr(0, i)));
  }
}

TEST(AccessRules, WantsProtocolAndTokenAmongTheSubprotocols) {
  const AccessRules rules(8123, kToken);
  EXPECT_TRUE(rules.offers_token("dismantle.1, token." + kToken));
  EXPECT_TRUE(rules.offers_token("token." + kToken + ",dismantle.1"));
  EXPECT_FALSE(rules.offers_token("dismantle.1"));
  EXPECT_FALSE(rules.offers_token("token." + kToken));
  EXPECT_FALSE(rules.offers_token("dismantle.2, token." + kToken));
  EXPECT_FALSE(rules.offers_token("dismantle.1, token."));
  EXPECT_FALSE(rules.offers_token("dismantle.1, token." + kToken.substr(1)));
  EXPECT_FALSE(rules.offers_token(",,,"));
}

TEST(AccessRules, ComparesWholeTexts) {
  EXPECT_TRUE(equal_in_constant_time("", ""));
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "ab"));
}

TEST(AccessRules, AllowsNoForeignSourceAndNoInlineScriptInThePolicy) {
  const std::string policy(AccessRules::content_security_policy());
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(policy.find("ws:"), std::string::npos);
  EXPECT_NE(policy.find("default-src 'self'"), std::string::npos);
  EXPECT_NE(policy.find("connect-src 'self'"), std::string::npos);
}

}  // namespace
}  // namespace dismantle::server
