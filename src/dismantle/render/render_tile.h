// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/project_scene.h"
#include "dismantle/render/rasterize.h"
#include "dismantle/render/shading.h"

#include <cstdint>
#include <vector>

namespace dismantle {

/// The primitives of a ProjectedScene that overlap a tile.
struct TileContents {
  std::array<std::vector<std::uint32_t>, kLayerCount> triangles;  ///< Indices by layer, ascending.
  std::array<std::vector<std::uint32_t>, kLayerCount> lines;      ///< Indices by layer, ascending.
};

/// Width of the border of samples around a tile that outline detection reads.
inline constexpr int kTileApron = 1;

/// Renders one tile independently of all others: the result does not depend on how an image is divided into tiles.
class TileRenderer {
 public:
  /// @param tile samples of the tile; a border of kTileApron is rendered in addition
  TileRenderer(const RenderScene& scene, const ProjectedScene& projected, const RenderOptions& options,
               const TileContents& contents, const SampleRect& tile);

  /// Renders the tile. @return light of each sample, shape [tile height + 2 kTileApron][tile width + 2 kTileApron]
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
  SampleRect rect_;  // with the border
  std::vector<LinearColor> item_colors_;
  LinearColor edge_color_;
  Visible opaque_;
  std::vector<std::uint8_t> capped_;
  std::vector<LinearColor> light_;
  std::vector<float> line_opacity_;
  std::vector<LinearColor> line_color_;
};

}  // namespace dismantle
