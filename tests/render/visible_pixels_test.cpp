// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/visible_pixels.h"

#include "dismantle/render/assembly_scene.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

/// Seen from the front: a wall, and behind it a wider one of which a fifth is visible.
RenderScene two_walls() {
  return make_scene(scenes::assembly({scenes::component("front", scenes::box({0, 0, 0}, {40, 1, 40})),
                                      scenes::component("back", scenes::box({0, 5, 0}, {50, 6, 40}))}));
}

Camera from_the_front(const RenderScene& scene) {
  CameraFit fit;
  fit.direction = view_direction(StandardView::Front);
  fit.aspect = 50.0 / 40;
  fit.margin = 0;
  return fit_camera(item_points(scene.items), fit);
}

TEST(VisiblePixels, CountWhatIsInFront) {
  const RenderScene scene = two_walls();
  const std::vector<std::size_t> pixels = visible_pixels(scene, from_the_front(scene), 100, 80);
  EXPECT_EQ(pixels, (std::vector<std::size_t>{80 * 80, 20 * 80}));
}

TEST(VisiblePixels, SeeThroughWhatIsTransparent) {
  RenderScene scene = two_walls();
  make_ghost(scene.items[0]);
  EXPECT_EQ(visible_pixels(scene, from_the_front(scene), 100, 80), (std::vector<std::size_t>{0, 100 * 80}));
}

}  // namespace
}  // namespace dismantle
