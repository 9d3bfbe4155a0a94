// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/step_picture.h"

#include "tests/instructions/bolted_lid.h"

namespace dismantle {
namespace {

/// The number of pixels of a picture in the colour of the moving components.
std::size_t orange_pixels(const Image& image) {
  return static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(), [](const Pixel& p) {
    return p.r > 140 && p.r > p.b + 90 && p.g > p.b + 20 && p.r > p.g + 30;
  }));
}

WorkStep pull(const Assembly& a, std::uint32_t c, Vec3 displacement) {
  return {{{{ComponentId(c)}, {{}, {displacement, {}}}}}, std::vector<Pose>(a.components.size())};
}

TEST(StepPicture, IsTakenFromTheSideOnWhichTheComponentIsSeen) {
  // A knob on one side of a wall: the view depends on the side.
  for (const double side : {1.0, -1.0}) {
    const Assembly a = scenes::assembly({scenes::component("wall", scenes::box({-5, -60, -60}, {5, 60, 60})),
                                         scenes::component("knob", side > 0 ? scenes::box({5, -9, -9}, {15, 9, 9})
                                                                            : scenes::box({-15, -9, -9}, {-5, 9, 9}))});
    StepPictureRenderer renderer(a, 160, 120, Executor());
    const StepPictures pictures = renderer.render_step(pull(a, 1, {100 * side, 0, 0}), PathDirection::Forward);
    EXPECT_LT(side * pictures.view.x, -0.2) << side;
    EXPECT_GT(orange_pixels(pictures.close), 300u) << side;
  }
}

TEST(StepPicture, ShowsAComponentThroughWhatHidesItFromAllSides) {
  const Assembly a = scenes::assembly({scenes::component("shell", scenes::box({-30, -30, -30}, {30, 30, 30})),
                                       scenes::component("core", scenes::box({-12, -12, -12}, {12, 12, 12}))});
  StepPictureRenderer renderer(a, 160, 120, Executor());
  EXPECT_GT(orange_pixels(renderer.render_step(pull(a, 1, {0, 0, 2}), PathDirection::Forward).close), 300u);
}

TEST(StepPicture, ShowsSmallComponentsCloseUpAndInContext) {
  const Assembly a = scenes::assembly({scenes::component("plate", scenes::box({-200, -200, -10}, {200, 200, 0})),
                                       scenes::component("pin", scenes::box({90, 90, 0}, {96, 96, 8}))});
  StepPictureRenderer renderer(a, 160, 120, Executor());
  const StepPictures pin = renderer.render_step(pull(a, 1, {0, 0, 50}), PathDirection::Forward);
  ASSERT_TRUE(pin.overview.has_value());
  EXPECT_GT(orange_pixels(pin.close), 3 * orange_pixels(*pin.overview));
  const Assembly lid = scenes::bolted_lid();
  EXPECT_FALSE(StepPictureRenderer(lid, 160, 120, Executor())
                   .render_step(pull(lid, 1, {0, 0, 50}), PathDirection::Forward)
                   .overview);
}

TEST(StepPicture, ShowsAPathOnlyAsFarAsItIsVisible) {
  // The picture shows the same region however far the pin is moved.
  const Assembly a = scenes::assembly({scenes::component("plate", scenes::box({-20, -20, -10}, {20, 20, 0})),
                                       scenes::component("pin", scenes::box({-3, -3, -5}, {3, 3, 8}))});
  const auto close = [&](double height) {
    return StepPictureRenderer(a, 160, 120, Executor())
        .render_step(pull(a, 1, {0, 0, height}), PathDirection::Forward)
        .close;
  };
  const std::size_t far = orange_pixels(close(1e5)), near = orange_pixels(close(200));
  EXPECT_GT(far, 100u);
  EXPECT_GT(10 * far, 9 * near);
  EXPECT_LT(10 * far, 11 * near);
}

TEST(StepPicture, KeepsItsViewIfAnotherIsNoBetter) {
  const Assembly a = scenes::bolted_lid();
  StepPictureRenderer renderer(a, 80, 60, Executor());
  const Vec3 first = renderer.render_step(pull(a, 2, {0, 0, 50}), PathDirection::Forward).view;
  EXPECT_EQ(renderer.render_step(pull(a, 3, {0, 0, 50}), PathDirection::Forward).view, first);
}

TEST(StepPicture, IsTheSameForAllExecutors) {
  const Assembly a = scenes::bolted_lid();
  const StepPictures serial =
      StepPictureRenderer(a, 80, 60, Executor()).render_step(pull(a, 2, {0, 0, 50}), PathDirection::Reversed);
  const StepPictures threads = StepPictureRenderer(a, 80, 60, Executor(ExecutorKind::Threads, 2))
                                   .render_step(pull(a, 2, {0, 0, 50}), PathDirection::Reversed);
  EXPECT_EQ(serial.close, threads.close);
}

}  // namespace
}  // namespace dismantle
