// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/render_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr std::uint32_t kNothing = 0xffffffffu;
constexpr float kFarthest = std::numeric_limits<float>::max();
// Lines are lifted off the surface that they lie on by this fraction of the scene's size.
constexpr double kLineLift = 4e-4;
// Depth step within one item that counts as an outline, as a fraction of the scene's size.
constexpr double kOutlineStep = 0.01;
// Transparent layers closer than this fraction of the scene's size (touching faces) count as one.
constexpr double kLayerGap = 1e-6;
constexpr float kOutlineOpacity = 0.85f;
constexpr float kCapDarkness = 0.80f;
constexpr int kCapStripe = 5;  // stripe width of the hatching of caps [pixels]

}  // namespace

TileRenderer::TileRenderer(const RenderScene& scene, const ProjectedScene& projected, const RenderOptions& options,
                           const TileContents& contents, const SampleRect& tile)
    : scene_(scene),
      projected_(projected),
      options_(options),
      contents_(contents),
      rect_{tile.x0 - kTileApron, tile.y0 - kTileApron, tile.x1 + kTileApron, tile.y1 + kTileApron},
      edge_color_(linear_from_srgb(options.edge_color)) {
  for (const RenderItem& item : scene.items) item_colors_.push_back(linear_from_srgb(item.color));
  const auto count = static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height());
  opaque_.key.assign(count, kFarthest);
  opaque_.triangle.assign(count, kNothing);
  capped_.assign(count, 0);
  light_.resize(count);
  line_opacity_.assign(count, 0);
  line_color_.resize(count);
}

const std::vector<LinearColor>& TileRenderer::draw() {
  fill_background();
  find_opaque();
  shade_opaque();
  mark_outlines();
  mark_lines(Layer::Opaque);
  blend_lines();
  blend_transparent();
  mark_lines(Layer::Transparent);
  blend_lines();
  blend_overlap();
  blend_overlay();
  mark_lines(Layer::Overlay);
  blend_lines();
  return light_;
}

void TileRenderer::fill_background() {
  const Color& top = options_.background_top;
  const Color& bottom = options_.background_bottom;
  const float rows = static_cast<float>(options_.height * options_.samples);
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    const float s = std::clamp((static_cast<float>(y) + 0.5f) / rows, 0.0f, 1.0f);
    const LinearColor color = linear_from_srgb(
        {top.r + s * (bottom.r - top.r), top.g + s * (bottom.g - top.g), top.b + s * (bottom.b - top.b)});
    std::fill_n(light_.begin() + static_cast<std::ptrdiff_t>(index(rect_.x0, y)), rect_.width(), color);
  }
}

void TileRenderer::find_opaque() {
  const auto& contents = contents_.triangles[static_cast<std::size_t>(Layer::Opaque)];
  const bool caps = scene_.section && scene_.section->cap;
  std::vector<std::int16_t> leaving(caps ? light_.size() : 0, 0);
  std::vector<std::uint32_t> touched;
  for (std::size_t at = 0; at < contents.size(); ++at) {
    const std::uint32_t i = contents[at];
    const ScreenTriangle& t = triangles(Layer::Opaque)[i];
    const bool counted = caps && item_of(t).closed && item_of(t).section;
    rasterize_triangle(t, rect_, [&](int x, int y, float key) {
      const std::size_t sample = index(x, y);
      if (counted) {
        leaving[sample] = static_cast<std::int16_t>(leaving[sample] + (t.back_facing ? 1 : -1));
        touched.push_back(static_cast<std::uint32_t>(sample));
      }
      if (key >= opaque_.key[sample]) return;
      opaque_.key[sample] = key;
      opaque_.triangle[sample] = i;
      if (caps) capped_[sample] = 0;
    });
    const bool item_ends = at + 1 == contents.size() || triangles(Layer::Opaque)[contents[at + 1]].item != t.item;
    if (counted && item_ends) cap_item(i, leaving, touched);
  }
}

/// Where the section plane cuts through a closed item, the ray of a sample exits the item once more than it enters it
/// behind the plane: there the cap is visible, at the depth of the plane.
void TileRenderer::cap_item(std::uint32_t triangle, std::vector<std::int16_t>& leaving,
                            std::vector<std::uint32_t>& touched) {
  const ViewTransform& view = projected_.view;
  const ViewPlane& plane = *projected_.section;
  for (const std::uint32_t sample : touched) {
    const bool inside = leaving[sample] > 0;
    leaving[sample] = 0;
    if (!inside) continue;
    const int x = rect_.x0 + static_cast<int>(sample) % rect_.width();
    const int y = rect_.y0 + static_cast<int>(sample) / rect_.width();
    const double vx = (x + 0.5 - view.center_x) / view.scale, vy = (view.center_y - y - 0.5) / view.scale;
    const double across = plane.normal.x * vx + plane.normal.y * vy;
    const double key =
        view.perspective ? -(across + plane.normal.z) / plane.offset : (plane.offset - across) / plane.normal.z;
    if (!(static_cast<float>(key) < opaque_.key[sample])) continue;
    opaque_.key[sample] = static_cast<float>(key);
    opaque_.triangle[sample] = triangle;
    capped_[sample] = 1;
  }
  touched.clear();
}

LinearColor TileRenderer::cap_color(const ScreenTriangle& t, int x, int y) const {
  const Vec3 n = projected_.section->normal;
  const SurfacePoint point{{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(-n.z)},
                           direction_to_eye(projected_.view, x, y)};
  const LinearColor color = shaded(kCapDarkness * item_colors_[t.item], point);
  const int stripe = ((x + (t.item % 2 == 0 ? y : -y)) / options_.samples + (1 << 20)) / kCapStripe;
  return stripe % 2 == 0 ? color : kCapDarkness * color;
}

void TileRenderer::shade_opaque() {
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    for (int x = rect_.x0; x < rect_.x1; ++x) {
      const std::size_t sample = index(x, y);
      if (opaque_.triangle[sample] == kNothing) continue;
      const ScreenTriangle& t = triangles(Layer::Opaque)[opaque_.triangle[sample]];
      light_[sample] = capped_[sample] != 0 ? cap_color(t, x, y)
                                            : shaded(item_colors_[t.item], surface_point(projected_.view, t, x, y));
    }
  }
}

/// True if a neighbouring sample shows another item or differs by a depth step.
bool TileRenderer::is_outline(int x, int y) const {
  const std::size_t here = index(x, y);
  const auto shown = [&](std::size_t sample) {
    if (opaque_.triangle[sample] == kNothing) return kNothing;
    return 2 * triangles(Layer::Opaque)[opaque_.triangle[sample]].item + capped_[sample];
  };
  const auto depth = [&](std::size_t sample) { return projected_.view.depth_of_key(opaque_.key[sample]); };
  const std::uint32_t item = shown(here);
  const std::size_t step[2] = {1, static_cast<std::size_t>(rect_.width())};
  for (const std::size_t s : step) {
    const std::uint32_t before = shown(here - s), after = shown(here + s);
    if (before != item || after != item) return true;
    if (item == kNothing) continue;
    const double bend = depth(here - s) - 2 * depth(here) + depth(here + s);
    if (std::abs(bend) > kOutlineStep * projected_.size) return true;
  }
  return false;
}

void TileRenderer::mark_outlines() {
  for (int y = rect_.y0 + 1; y + 1 < rect_.y1; ++y) {
    for (int x = rect_.x0 + 1; x + 1 < rect_.x1; ++x) {
      if (!is_outline(x, y)) continue;
      line_opacity_[index(x, y)] = kOutlineOpacity;
      line_color_[index(x, y)] = edge_color_;
    }
  }
}

bool TileRenderer::hidden(const ScreenLine& line, std::size_t sample, float key) const {
  const ViewTransform& view = projected_.view;
  const double lifted = view.depth_of_key(key) - kLineLift * projected_.size;
  if (view.key_of_depth(std::max(lifted, view.near_depth)) <= opaque_.key[sample]) return false;
  if (!line.is_edge || capped_[sample] != 0) return true;
  const ScreenTriangle& t = triangles(Layer::Opaque)[opaque_.triangle[sample]];
  return t.item != line.item || (t.face != line.faces[0] && t.face != line.faces[1]);
}

void TileRenderer::mark_lines(Layer layer) {
  const auto slot = static_cast<std::size_t>(layer);
  for (const std::uint32_t i : contents_.lines[slot]) {
    const ScreenLine& line = projected_.lines[slot][i];
    const LinearColor color = linear_from_srgb(line.color);
    rasterize_line(line, rect_, [&](int x, int y, float key) {
      const std::size_t sample = index(x, y);
      if (line.color.a <= line_opacity_[sample]) return;
      if (layer != Layer::Overlay && hidden(line, sample, key)) return;
      line_opacity_[sample] = line.color.a;
      line_color_[sample] = color;
    });
  }
}

void TileRenderer::blend_lines() {
  for (std::size_t sample = 0; sample < light_.size(); ++sample) {
    if (line_opacity_[sample] == 0) continue;
    light_[sample] = blended(light_[sample], line_color_[sample], line_opacity_[sample]);
    line_opacity_[sample] = 0;
  }
}

/// Finds the nearest transparent surfaces behind `in_front_of` and in front of the opaque ones; false if there are
/// none.
bool TileRenderer::find_transparent_layer(const std::vector<float>& in_front_of, Visible& found) const {
  found.key = opaque_.key;
  found.triangle.assign(found.key.size(), kNothing);
  bool any = false;
  for (const std::uint32_t i : contents_.triangles[static_cast<std::size_t>(Layer::Transparent)]) {
    rasterize_triangle(triangles(Layer::Transparent)[i], rect_, [&](int x, int y, float key) {
      const std::size_t sample = index(x, y);
      if (key >= found.key[sample] || key <= in_front_of[sample]) return;
      found.key[sample] = key;
      found.triangle[sample] = i;
      any = true;
    });
  }
  return any;
}

void TileRenderer::blend_surfaces(Layer layer, const Visible& visible) {
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    for (int x = rect_.x0; x < rect_.x1; ++x) {
      const std::size_t sample = index(x, y);
      if (visible.triangle[sample] == kNothing) continue;
      const ScreenTriangle& t = triangles(layer)[visible.triangle[sample]];
      const SurfacePoint point = surface_point(projected_.view, t, x, y);
      const float opacity = item_of(t).color.a;
      light_[sample] = blended(light_[sample], shaded(item_colors_[t.item], point),
                               opacity < 1 ? apparent_opacity(opacity, point) : 1.0f);
    }
  }
}

void TileRenderer::blend_transparent() {
  if (contents_.triangles[static_cast<std::size_t>(Layer::Transparent)].empty()) return;
  std::vector<Visible> layers;
  std::vector<float> in_front_of(light_.size(), -kFarthest);
  const ViewTransform& view = projected_.view;
  for (int i = 0; i < options_.transparent_layers; ++i) {
    Visible layer;
    if (!find_transparent_layer(in_front_of, layer)) break;
    for (std::size_t sample = 0; sample < light_.size(); ++sample) {
      if (layer.triangle[sample] == kNothing) continue;
      const double depth = view.depth_of_key(layer.key[sample]) + kLayerGap * projected_.size;
      in_front_of[sample] = static_cast<float>(view.key_of_depth(depth));
    }
    layers.push_back(std::move(layer));
  }
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) blend_surfaces(Layer::Transparent, *layer);
}

void TileRenderer::blend_overlay() {
  const auto& contents = contents_.triangles[static_cast<std::size_t>(Layer::Overlay)];
  if (contents.empty()) return;
  Visible nearest{std::vector<float>(light_.size(), kFarthest), std::vector<std::uint32_t>(light_.size(), kNothing)};
  for (const std::uint32_t i : contents) {
    rasterize_triangle(triangles(Layer::Overlay)[i], rect_, [&](int x, int y, float key) {
      const std::size_t sample = index(x, y);
      if (key >= nearest.key[sample]) return;
      nearest.key[sample] = key;
      nearest.triangle[sample] = i;
    });
  }
  blend_surfaces(Layer::Overlay, nearest);
}

/// Marks the samples whose ray passes through the inside of both items at once.
void TileRenderer::blend_overlap() {
  const auto& contents = contents_.triangles[static_cast<std::size_t>(Layer::Overlap)];
  if (!scene_.overlap || contents.empty()) return;
  struct Crossing {
    std::uint32_t sample;
    float depth;
    std::uint8_t item;
    bool leaves;
  };
  std::vector<Crossing> crossings;
  for (const std::uint32_t i : contents) {
    const ScreenTriangle& t = triangles(Layer::Overlap)[i];
    rasterize_triangle(t, rect_, [&](int x, int y, float key) {
      crossings.push_back({static_cast<std::uint32_t>(index(x, y)),
                           static_cast<float>(projected_.view.depth_of_key(key)), static_cast<std::uint8_t>(t.item),
                           t.back_facing});
    });
  }
  std::stable_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.sample != b.sample ? a.sample < b.sample : a.depth < b.depth;
  });

  const LinearColor color = linear_from_srgb(scene_.overlap->color);
  const double thinnest = kLayerGap * projected_.size;
  int inside[2] = {0, 0};
  bool marked = false;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const Crossing& c = crossings[i];
    if (i == 0 || crossings[i - 1].sample != c.sample) {
      inside[0] = inside[1] = 0;
      marked = false;
    }
    const bool in_both = inside[0] > 0 && inside[1] > 0;
    if (in_both && !marked && c.depth - crossings[i - 1].depth > thinnest) {
      light_[c.sample] = blended(light_[c.sample], color, scene_.overlap->color.a);
      marked = true;
    }
    inside[c.item] += c.leaves ? -1 : 1;
  }
}

}  // namespace dismantle
