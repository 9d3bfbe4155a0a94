// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// Ends the test because something is missing: skips it, or fails if the environment has DISMANTLE_REQUIRE_DATA.
#define DISMANTLE_SKIP_OR_FAIL(reason)                                                                   \
  do {                                                                                                   \
    if (std::getenv("DISMANTLE_REQUIRE_DATA")) FAIL() << (reason) << " (DISMANTLE_REQUIRE_DATA is set)"; \
    GTEST_SKIP() << (reason);                                                                            \
  } while (false)

/// Ends the test as DISMANTLE_SKIP_OR_FAIL does if there is no such file or folder.
#define DISMANTLE_NEED(file)                                                                                           \
  do {                                                                                                                 \
    const std::filesystem::path needed(file);                                                                          \
    if (!std::filesystem::exists(needed)) DISMANTLE_SKIP_OR_FAIL("there is no " + needed.lexically_normal().string()); \
  } while (false)

namespace dismantle {

/// The folder of test data beside the repository. It may be missing: DISMANTLE_NEED what is read from it.
inline std::filesystem::path data_folder() {
  return std::filesystem::path(DISMANTLE_SOURCE_DIR) / "../shared/data";
}

}  // namespace dismantle
