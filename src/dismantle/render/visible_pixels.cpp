// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/visible_pixels.h"

#include "dismantle/render/project_scene.h"
#include "dismantle/render/rasterize.h"

#include <limits>

namespace dismantle {

std::vector<std::size_t> visible_pixels(RenderScene scene, const Camera& camera, int width, int height) {
  DISMANTLE_EXPECT(width > 0 && height > 0);
  constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
  for (RenderItem& item : scene.items) item.edge_opacity = 0;
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = 1;
  const ProjectedScene projected = project_scene(scene, camera, options);

  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<double> keys(count, std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> front(count, kNothing);
  for (const ScreenTriangle& t : projected.triangles[static_cast<std::size_t>(Layer::Opaque)]) {
    rasterize_triangle(t, {0, 0, width, height}, [&](int x, int y, double key) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (key >= keys[i]) return;
      keys[i] = key;
      front[i] = t.item;
    });
  }
  std::vector<std::size_t> visible(scene.items.size());
  for (const std::uint32_t item : front)
    if (item != kNothing) ++visible[item];
  return visible;
}

}  // namespace dismantle
