// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render.h"

#include "dismantle/render/assembly_scene.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace dismantle {
namespace {

constexpr Color kRed{0.8f, 0.1f, 0.1f}, kGreen{0.1f, 0.7f, 0.1f}, kBlue{0.1f, 0.1f, 0.9f};

RenderItem body(const TriangleMesh& mesh, Color color) {
  RenderItem item;
  item.mesh = std::make_shared<const RenderMesh>(make_render_mesh(mesh));
  item.color = color;
  item.closed = true;
  return item;
}

/// Faces along +y the square from (-10, -10) to (10, 10) of the x-z plane: a pixel is 0.2 mm.
Camera front_camera() {
  Camera camera;
  camera.eye = {0, -100, 0};
  camera.height = 20;
  return camera;
}

RenderOptions small_picture() {
  RenderOptions options;
  options.width = options.height = 100;
  return options;
}

const Pixel& at(const Image& image, double x, double z) {
  return image.at(static_cast<int>((x + 10) * 5), static_cast<int>((10 - z) * 5));
}

bool is_reddish(const Pixel& p) {
  return p.r > 2 * p.g && p.r > 2 * p.b;
}
bool is_greenish(const Pixel& p) {
  return p.g > 2 * p.r && p.g > 2 * p.b;
}
bool is_bluish(const Pixel& p) {
  return p.b > 2 * p.r && p.b > 2 * p.g;
}
bool is_background(const Pixel& p) {
  return p.r > 230 && p.g > 230 && p.b > 230;
}
TEST(Render, ShowsABoxAtItsPosition) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({2, 0, 1}, {6, 3, 7}), kRed));
  const Image image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_reddish(at(image, 4, 4)));
  EXPECT_TRUE(is_reddish(at(image, 2.7, 1.7)));
  EXPECT_TRUE(is_reddish(at(image, 5.3, 6.3)));
  EXPECT_TRUE(is_background(at(image, 1.1, 4)));
  EXPECT_TRUE(is_background(at(image, 6.9, 4)));
  EXPECT_TRUE(is_background(at(image, 4, 0.1)));
  EXPECT_TRUE(is_background(at(image, 4, 7.9)));
  EXPECT_LT(at(image, 2.05, 4).r, 0.85 * at(image, 4, 4).r) << "its left edge is drawn as a line";
}

TEST(Render, PerspectiveMakesTheFarBoxSmaller) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-2, 50, -2}, {2, 60, 2}), kRed));
  Camera camera = front_camera();
  camera.projection = Projection::Perspective;
  camera.field_of_view = 2 * std::atan(0.1);  // 20 mm high at the target's distance
  const Image image = render(scene, camera, small_picture());
  EXPECT_TRUE(is_reddish(at(image, 1.1, 0)));
  EXPECT_TRUE(is_background(at(image, 1.7, 0)));  // 2 mm at 150 mm look like 1.33 mm at 100 mm
}

TEST(Render, PerspectiveCutsOffWhatIsBehindTheEye) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-5, -300, -5}, {5, -200, 5}), kRed));
  scene.items.push_back(body(scenes::box({-500, -400, -9}, {500, 400, -8}), kGreen));  // the eye is above this floor
  Camera camera = front_camera();
  camera.projection = Projection::Perspective;
  const Image image = render(scene, camera, small_picture());
  EXPECT_TRUE(is_background(image.at(50, 20)));
  EXPECT_TRUE(is_greenish(image.at(50, 95)));
}

TEST(Render, TheNearerBodyHidesTheFartherWhateverTheirOrder) {
  const RenderItem near_body = body(scenes::box({-3, -20, -3}, {3, -10, 3}), kRed);
  const RenderItem far_body = body(scenes::box({-6, 0, -6}, {6, 10, 6}), kGreen);
  for (const bool near_first : {true, false}) {
    RenderScene scene;
    scene.items = near_first ? std::vector{near_body, far_body} : std::vector{far_body, near_body};
    const Image image = render(scene, front_camera(), small_picture());
    EXPECT_TRUE(is_reddish(at(image, 0, 0)));
    EXPECT_TRUE(is_greenish(at(image, 5, 0)));
  }
}

TEST(Render, ATransparentBodyLetsWhatIsBehindShineThrough) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-3, -20, -3}, {3, -10, 3}), kRed));
  scene.items.push_back(body(scenes::box({-6, 0, -6}, {6, 10, 6}), kGreen));
  const Pixel opaque = at(render(scene, front_camera(), small_picture()), 0, 0);
  scene.items[0].color.a = 0.5f;
  const Image image = render(scene, front_camera(), small_picture());
  const Pixel mixed = at(image, 0, 0), behind = at(image, 5, 0);
  EXPECT_LT(mixed.r, opaque.r);
  EXPECT_GT(mixed.r, behind.r);
  EXPECT_GT(mixed.g, opaque.g);
  EXPECT_LT(mixed.g, behind.g);
}

TEST(Render, TransparentLayersMixInDepthOrderWhateverTheirOrder) {
  RenderItem first = body(scenes::box({-3, -30, -3}, {3, -25, 3}), kRed);
  RenderItem second = body(scenes::box({-3, -20, -3}, {3, -10, 3}), kBlue);
  first.color.a = second.color.a = 0.6f;
  first.edge_opacity = second.edge_opacity = 0;
  RenderScene scene;
  scene.items = {first, second};
  const Image image = render(scene, front_camera(), small_picture());
  scene.items = {second, first};
  EXPECT_EQ(render(scene, front_camera(), small_picture()), image);
  EXPECT_GT(at(image, 0, 0).r, at(image, 0, 0).b) << "the red one is in front";
}

TEST(Render, ASectionTakesAwayTheNearHalfAndCapsTheCut) {
  RenderScene scene;
  scene.items.push_back(body(scenes::tube(6, 3, -8, 8, 32), kRed));
  scene.items.push_back(body(scenes::box({-1, -1, -8}, {1, 1, 8}), kBlue));
  EXPECT_TRUE(is_reddish(at(render(scene, front_camera(), small_picture()), 0, 0))) << "whole, the tube hides the rod";
  scene.section = section_facing(front_camera(), {0, 1, 0}, {0, 0, 0});
  EXPECT_EQ(scene.section->normal, (Vec3{0, -1, 0}));
  const Image image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_bluish(at(image, 0.3, 0))) << "the cap of the rod";
  EXPECT_TRUE(is_reddish(at(image, 4.5, 0))) << "the cap of the tube's wall";
  EXPECT_TRUE(is_reddish(at(image, 2, 0))) << "the bore's far wall";
  EXPECT_TRUE(is_background(at(image, 7, 0)));
}

TEST(Render, ShowsTheCapOfAnItemThatAnotherOverlaps) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-6, -5, -6}, {6, 5, 6}), kRed));
  scene.items.push_back(
      body(scenes::box({-2, 1, -2}, {2, 9, 2}), kBlue));  // starts inside the red one, behind the plane
  scene.section = section_facing(front_camera(), {0, 1, 0}, {0, 0, 0});
  EXPECT_TRUE(is_reddish(at(render(scene, front_camera(), small_picture()), 0.3, 0)));
}

TEST(Render, AnOverlayIsHiddenByNothing) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-6, -20, -6}, {6, -10, 6}), kRed));
  scene.items.push_back(make_arrow({0, 5, -5}, {0, 5, 5}, 0.8, kGreen));
  const Image image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_greenish(at(image, 0, -3)));
  EXPECT_TRUE(is_greenish(at(image, 1.5, 1.2))) << "the head is wider than the shaft";
  EXPECT_TRUE(is_reddish(at(image, 1.5, -3)));
}

TEST(Render, LinesAreHiddenByBodiesInFrontOfThem) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-6, -2, -6}, {0, 2, 6}), kRed));
  scene.lines.push_back({{{-9, 5, 0}, {9, 5, 0}}, kGreen, 3.0f, false});
  Image image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_reddish(at(image, -3, 0)));
  EXPECT_TRUE(is_greenish(at(image, 5, 0)));
  scene.lines[0].overlay = true;
  image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_greenish(at(image, -3, 0)));
}

TEST(Render, MarksTheCommonVolumeOfTwoBodies) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-6, 0, -3}, {2, 10, 3}), kBlue));
  scene.items.push_back(body(scenes::box({-1, 5, -3}, {6, 15, 3}), kGreen));
  scene.overlap = OverlapMark{{0, 1}, {1.0f, 0.0f, 0.0f, 1.0f}};
  const Image image = render(scene, front_camera(), small_picture());
  EXPECT_TRUE(is_reddish(at(image, 0.5, 0)));
  EXPECT_TRUE(is_bluish(at(image, -3, 0)));
  EXPECT_TRUE(is_greenish(at(image, 4, 0)));
}

TEST(Render, BodiesThatOnlyTouchHaveNoCommonVolume) {
  RenderScene scene;
  scene.items.push_back(body(scenes::box({-6, 0, -3}, {6, 5, 3}), kBlue));
  scene.items.push_back(body(scenes::box({-6, 5, -3}, {6, 9, 3}), kGreen));
  const Image plain = render(scene, front_camera(), small_picture());
  scene.overlap = OverlapMark{{0, 1}, {1.0f, 0.0f, 0.0f, 1.0f}};
  EXPECT_EQ(render(scene, front_camera(), small_picture()), plain);
}

TEST(Render, LeavesNoGapBetweenTrianglesThatShareAnEdge) {
  TriangleMesh fan;  // a disc of slivers, seen from the front
  constexpr std::uint32_t kSides = 397;
  fan.vertices.push_back({0.013, 0, 0.007});
  for (std::uint32_t i = 0; i < kSides; ++i)
    fan.vertices.push_back({9 * std::cos(i * 6.283185307 / kSides), 0, 9 * std::sin(i * 6.283185307 / kSides)});
  for (std::uint32_t i = 0; i < kSides; ++i) fan.faces.push_back({{0, 1 + i, 1 + (i + 1) % kSides}});
  RenderScene scene;
  scene.items.push_back(body(fan, kRed));
  scene.items[0].edge_opacity = 0;
  const Image image = render(scene, front_camera(), small_picture());
  const Pixel middle = at(image, 0, 0);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (std::hypot(x - 49.5, y - 49.5) > 43) continue;
      EXPECT_EQ(image.at(x, y), middle) << x << " " << y;
    }
  }
}

TEST(Render, GivesTheSamePixelsOnEveryExecutor) {
  RenderScene scene;
  scene.items.push_back(body(scenes::tube(6, 3, -8, 8, 48), kRed));
  scene.items.push_back(body(scenes::tube(3.2, 0, -9, 9, 24), kGreen));
  scene.items[0].color.a = 0.4f;
  CameraFit fit;
  const Camera camera = fit_camera(item_points(scene.items), fit);
  RenderOptions options;
  options.width = 133;
  options.height = 71;
  const Image serial = render(scene, camera, options);
  options.executor = Executor(ExecutorKind::Shuffled);
  EXPECT_EQ(render(scene, camera, options), serial);
  options.executor = Executor(ExecutorKind::Threads, 3);
  EXPECT_EQ(render(scene, camera, options), serial);
}

TEST(Render, AnEmptySceneIsAllBackground) {
  const Image image = render({}, front_camera(), small_picture());
  ASSERT_EQ(image.pixels.size(), 10000u);
  for (const Pixel& p : image.pixels) EXPECT_TRUE(is_background(p));
}

}  // namespace
}  // namespace dismantle
