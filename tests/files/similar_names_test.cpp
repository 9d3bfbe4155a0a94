// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/similar_names.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

using Names = std::vector<std::string>;
const Names kCommands{"info", "check", "convert", "plan", "why"};

TEST(SimilarNames, FindsNamesThatAreAFewLettersOff) {
  EXPECT_EQ(similar_names("inf", kCommands), Names{"info"});
  EXPECT_EQ(similar_names("ifno", kCommands), Names{"info"});
  EXPECT_EQ(similar_names("Chekc", kCommands), Names{"check"});
  EXPECT_EQ(similar_names("plane", kCommands), Names{"plan"});
}

TEST(SimilarNames, FindsNamesThatContainTheTextTheShortestFirst) {
  const Names names{"010_shaft-10", "000_shaft-1", "bearing"};
  EXPECT_EQ(similar_names("shaft-1", names), (Names{"000_shaft-1", "010_shaft-10"}));
  EXPECT_EQ(similar_names("shaft-1", names, 1), Names{"000_shaft-1"});
}

TEST(SimilarNames, FindsNamesThatBeginAlike) {
  EXPECT_EQ(similar_names("objektive", Names{"stand", "objective 4x"}), Names{"objective 4x"});
  EXPECT_TRUE(similar_names("in", Names{"on the left"}).empty());
}

TEST(SimilarNames, FindsNothingWhereNothingIsAlike) {
  EXPECT_TRUE(similar_names("dance", kCommands).empty());
  EXPECT_TRUE(similar_names("", kCommands).empty());
  EXPECT_TRUE(similar_names(std::string(100000, 'x'), kCommands).empty());
}

TEST(DidYouMean, ListsTheNamesInASentence) {
  EXPECT_EQ(did_you_mean("inf", kCommands), "; did you mean 'info'?");
  EXPECT_EQ(did_you_mean("shaft", Names{"shaft-1", "shaft-2", "shaft-3", "shaft-4"}),
            "; did you mean 'shaft-1', 'shaft-2' or 'shaft-3'?");
  EXPECT_EQ(did_you_mean("dance", kCommands), "");
}

}  // namespace
}  // namespace dismantle
