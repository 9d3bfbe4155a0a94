// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render.h"

#include "dismantle/render/render_tile.h"

#include <algorithm>

namespace dismantle {

namespace {

constexpr int kTilePixels = 32;

/// The tiles of an image in row order, and the primitives that overlap each.
class TileGrid {
 public:
  TileGrid(const RenderOptions& options, const ProjectedScene& projected)
      : options_(options),
        columns_((options.width + kTilePixels - 1) / kTilePixels),
        rows_((options.height + kTilePixels - 1) / kTilePixels),
        contents_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
      const auto& triangles = projected.triangles[layer];
      for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto [left, right] = std::minmax({triangles[i].x[0], triangles[i].x[1], triangles[i].x[2]});
        const auto [top, bottom] = std::minmax({triangles[i].y[0], triangles[i].y[1], triangles[i].y[2]});
        for_tiles(left, right, top, bottom, [&](TileContents& c) { c.triangles[layer].push_back(i); });
      }
      const auto& lines = projected.lines[layer];
      for (std::uint32_t i = 0; i < lines.size(); ++i) {
        const auto [left, right] = std::minmax(lines[i].x[0], lines[i].x[1]);
        const auto [top, bottom] = std::minmax(lines[i].y[0], lines[i].y[1]);
        const float w = lines[i].half_width;
        for_tiles(left - w, right + w, top - w, bottom + w, [&](TileContents& c) { c.lines[layer].push_back(i); });
      }
    }
  }

  std::size_t count() const { return contents_.size(); }
  const TileContents& contents(std::size_t tile) const { return contents_[tile]; }
  /// The samples of a tile; tiles at the border may extend beyond the image.
  SampleRect samples(std::size_t tile) const {
    const int side = kTilePixels * options_.samples;
    const int x = static_cast<int>(tile) % columns_ * side, y = static_cast<int>(tile) / columns_ * side;
    return {x, y, x + side, y + side};
  }

 private:
  template <class Visit>
  void for_tiles(float left, float right, float top, float bottom, const Visit& visit) {
    const float side = static_cast<float>(kTilePixels * options_.samples);
    const auto tile_of = [side](float at, int count) {
      return static_cast<int>(std::clamp(std::floor(at / side), -1.0f, static_cast<float>(count)));
    };
    const int x0 = std::max(0, tile_of(left - kTileApron, columns_));
    const int x1 = std::min(columns_ - 1, tile_of(right + kTileApron, columns_));
    const int y0 = std::max(0, tile_of(top - kTileApron, rows_));
    const int y1 = std::min(rows_ - 1, tile_of(bottom + kTileApron, rows_));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        visit(
            contents_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)]);
  }

  const RenderOptions& options_;
  int columns_, rows_;
  std::vector<TileContents> contents_;
};

/// Downsamples one pixel: the mean of its samples.
Pixel resolved(const std::vector<LinearColor>& light, int row_width, int x, int y, int samples) {
  LinearColor sum;
  for (int sy = 0; sy < samples; ++sy) {
    const auto row = static_cast<std::size_t>(kTileApron + y * samples + sy) * static_cast<std::size_t>(row_width);
    for (int sx = 0; sx < samples; ++sx) sum += light[row + static_cast<std::size_t>(kTileApron + x * samples + sx)];
  }
  return srgb_from_linear(sum / static_cast<float>(samples * samples));
}

}  // namespace

Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options) {
  DISMANTLE_EXPECT(options.width > 0 && options.height > 0 && options.samples > 0 && options.transparent_layers > 0);
  const ProjectedScene projected = project_scene(scene, camera, options);
  const TileGrid grid(options, projected);

  Image image{options.width, options.height, {}};
  image.pixels.resize(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
  options.executor.for_each_heavy(grid.count(), [&](std::size_t tile) {
    const SampleRect rect = grid.samples(tile);
    TileRenderer renderer(scene, projected, options, grid.contents(tile), rect);
    const std::vector<LinearColor>& light = renderer.draw();
    const int x0 = rect.x0 / options.samples, y0 = rect.y0 / options.samples;
    for (int y = 0; y < kTilePixels && y0 + y < options.height; ++y)
      for (int x = 0; x < kTilePixels && x0 + x < options.width; ++x)
        image.pixels[static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(options.width) +
                     static_cast<std::size_t>(x0 + x)] =
            resolved(light, rect.width() + 2 * kTileApron, x, y, options.samples);
  });
  return image;
}

}  // namespace dismantle
