// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace dismantle {

/// The message of the result's error; "" if there is none.
template <class T>
std::string message_of(const Result<T>& result) {
  return result ? "" : result.error().message;
}

/// Expects an Error of kind Unreadable, one sentence "<problem> (<why>); <what to do>" that contains `why`.
template <class T>
void expect_unreadable(const Result<T>& result, std::string_view why) {
  ASSERT_FALSE(result.ok()) << "expected an error about " << why;
  const std::string& message = result.error().message;
  EXPECT_EQ(result.error().kind, ErrorKind::Unreadable) << message;
  EXPECT_NE(message.find(why), std::string::npos) << message;
  EXPECT_NE(message.find(" ("), std::string::npos) << message;
  EXPECT_NE(message.find("); "), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

}  // namespace dismantle
