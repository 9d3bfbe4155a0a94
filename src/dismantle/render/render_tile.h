// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/project_scene.h"
#include "dismantle/render/rasterize.h"
#include "dismantle/render/shading.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// What of a ProjectedScene touches a tile: indices into its triangles and lines, ascending.
struct TileContents {
  std::array<std::vector<std::uint32_t>, kLayerCount> triangles;
  std::array<std::vector<std::uint32_t>, kLayerCount> lines;
};

/// Samples around a tile that its outlines look at.
inline constexpr int kTileApron = 1;

/// Draws one rectangle of samples, by itself: every tile gives what a picture of one tile would.
class TileRenderer {
 public:
  /// @param tile the samples wanted, a kTileApron more on each side is drawn
  TileRenderer(const RenderScene& scene, const ProjectedScene& projected, const RenderOptions& options,
               const TileContents& contents, const SampleRect& tile);

  /// Light of each sample of the rectangle with its apron. Shape [tile.height + 2 apron][tile.width + 2 apron].
  const std::vector<LinearColor>& draw();

 private:
  struct Visible {
    std::vector<float> key;
    std::vector<std::uint32_t> triangle;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
           static_cast<std::size_t>(x - rect_.x0);
  }
  const std::vector<ScreenTriangle>& triangles(Layer layer) const {
    return projected_.triangles[static_cast<std::size_t>(layer)];
  }
  const RenderItem& item_of(const ScreenTriangle& t) const { return scene_.items[t.item]; }

  void fill_background();
  void find_opaque();
  void cap_item(std::uint32_t triangle, std::vector<std::int16_t>& leaving, std::vector<std::uint32_t>& touched);
  void shade_opaque();
  LinearColor cap_color(const ScreenTriangle& t, int x, int y) const;
  void mark_outlines();
  bool is_outline(int x, int y) const;
  void mark_lines(Layer layer);
  bool hidden(const ScreenLine& line, std::size_t sample, float key) const;
  void blend_lines();
  void blend_transparent();
  bool find_transparent_layer(const std::vector<float>& in_front_of, Visible& found) const;
  void blend_surfaces(Layer layer, const Visible& visible);
  void blend_overlap();
  void blend_overlay();

  const RenderScene& scene_;
  const ProjectedScene& projected_;
  const RenderOptions& options_;
  const TileContents& contents_;
  SampleRect rect_;  // with the apron
  std::vector<LinearColor> item_colors_;
  LinearColor edge_color_;
  Visible opaque_;
  std::vector<std::uint8_t> capped_;
  std::vector<LinearColor> light_;
  std::vector<float> line_opacity_;
  std::vector<LinearColor> line_color_;
};

}  // namespace dismantle
