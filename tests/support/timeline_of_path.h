// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/session/timeline.h"

#include <gtest/gtest.h>

namespace dismantle::scenes {

/// The timeline of a path of a scene that has no contacts. Fails the test if the path does not fit the assembly.
inline Timeline timeline_of(const Assembly& assembly, const Path& path) {
  const Result<Timeline> timeline = Timeline::of_path(assembly, path);
  EXPECT_TRUE(timeline.ok()) << timeline.error().message;
  return *timeline;
}

}  // namespace dismantle::scenes
