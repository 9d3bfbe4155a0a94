// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/text_name.h"

#include <gtest/gtest.h>

namespace dismantle {

TEST(TextName, LeavesCleanNamesAlone) {
  for (const char* name : {"", "bolt M8 #2", "Geh\xc3\xa4use", "\xe6\xad\xaf\xe8\xbd\xae", "\xf0\x9f\x94\xa9"})
    EXPECT_EQ(clean_name(name), name);
}

TEST(TextName, ReadsInvalidUtf8AsLatin1) {
  EXPECT_EQ(clean_name("Geh\xe4use"), "Geh\xc3\xa4use");
  EXPECT_EQ(clean_name("\xc0\xaf"), "\xc3\x80\xc2\xaf") << "overlong";
  EXPECT_EQ(clean_name("\xed\xa0\x80"), "\xc3\xad\xc2\xa0_") << "a surrogate; its last byte is a control character";
  EXPECT_EQ(clean_name("a\xe6\xad"), "a\xc3\xa6\xc2\xad") << "cut short";
}

TEST(TextName, ReplacesControlCharacters) {
  EXPECT_EQ(clean_name(std::string_view("a\0b\n\x1b[31m\x7f", 9)), "a_b__[31m");
  EXPECT_EQ(clean_name("a\x7f\xc2\x9b"
                       "b"),
            "a__b");
}

TEST(TextName, MakesFileStems) {
  EXPECT_EQ(file_stem("bolt"), "bolt");
  EXPECT_EQ(file_stem("a/b"), "a_b");
  EXPECT_EQ(file_stem("../../etc/passwd"), "_.._.._etc_passwd");
  EXPECT_EQ(file_stem(""), "_");
  EXPECT_EQ(file_stem("."), "_.");
  EXPECT_EQ(file_stem(std::string(300, 'x')).size(), 200u);
  EXPECT_EQ(file_stem(std::string(199, 'x') + "\xc3\xa4"), std::string(199, 'x')) << "no half character";
}

}  // namespace dismantle
