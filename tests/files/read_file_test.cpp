// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/read_file.h"

#include "tests/support/parse_expectations.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace dismantle {

TEST(ReadFile, ReadsEveryByte) {
  const ScratchFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  const auto result = read_file(folder.put("a.bin", bytes), 6);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(*result, bytes);
}

TEST(ReadFile, RefusesNonFilesAndFilesAboveTheLimit) {
  const ScratchFolder folder;
  EXPECT_NE(message_of(read_file(folder / "missing", 10)).find("No such file"), std::string::npos);
  EXPECT_NE(message_of(read_file(folder.path(), 10)).find("it is a folder"), std::string::npos);
  EXPECT_NE(message_of(read_file(folder.put("empty", ""), 10)).find("it is empty"), std::string::npos);
  EXPECT_NE(message_of(read_file(folder.put("large", "12345678901"), 10)).find("11 bytes, more than the limit of 10"),
            std::string::npos);
  EXPECT_NE(message_of(read_file("/dev/zero", 10)).find("not a regular file"), std::string::npos);
  EXPECT_EQ(read_file(folder / "missing", 10).error().kind, ErrorKind::Unreadable);
}

TEST(ReadFile, DoesNotHangOnAPipeWithoutAWriter) {
  const ScratchFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(message_of(read_file(folder / "pipe", 10)).find("not a regular file"), std::string::npos);
}

}  // namespace dismantle
