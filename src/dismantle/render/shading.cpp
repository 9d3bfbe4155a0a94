// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/shading.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

constexpr float kAmbient = 0.22f;
constexpr float kSkyLight = 0.10f;  // more ambient light from above
constexpr float kKeyLight = 0.62f;
constexpr float kFillLight = 0.20f;
constexpr float kHighlight = 0.10f;

const Vec3f kKeyDirection = normalized(Vec3f{-0.45f, 0.60f, 1.0f});
const Vec3f kFillDirection = normalized(Vec3f{0.80f, -0.10f, 0.70f});

float linear_channel(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

float srgb_channel(float l) {
  return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f;
}

/// Table from linear values to sRGB bytes, fine enough for every byte to occur.
const std::array<std::uint8_t, 4096>& srgb_table() {
  static const std::array<std::uint8_t, 4096> kTable = [] {
    std::array<std::uint8_t, 4096> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_channel(static_cast<float>(i) / 4095)));
    return table;
  }();
  return kTable;
}

std::uint8_t srgb_byte(float linear) {
  return srgb_table()[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0f, 1.0f) * 4095))];
}

}  // namespace

LinearColor linear_from_srgb(const Color& color) {
  return {linear_channel(color.r), linear_channel(color.g), linear_channel(color.b)};
}

Pixel srgb_from_linear(LinearColor color) {
  return {srgb_byte(color.x), srgb_byte(color.y), srgb_byte(color.z)};
}

Vec3f direction_to_eye(const ViewTransform& view, int x, int y) {
  if (!view.perspective) return {0, 0, 1};
  return normalized(Vec3f{static_cast<float>((view.center_x - x - 0.5) / view.scale),
                          static_cast<float>((y + 0.5 - view.center_y) / view.scale), 1});
}

SurfacePoint surface_point(const ViewTransform& view, const ScreenTriangle& t, int x, int y) {
  const float px = static_cast<float>(x) + 0.5f - t.x[0], py = static_cast<float>(y) + 0.5f - t.y[0];
  const float ax = t.x[1] - t.x[0], ay = t.y[1] - t.y[0], bx = t.x[2] - t.x[0], by = t.y[2] - t.y[0];
  const float area = ax * by - bx * ay;
  float u = std::clamp((px * by - bx * py) / area, 0.0f, 1.0f);
  float v = std::clamp((ax * py - px * ay) / area, 0.0f, 1.0f);
  if (u + v > 1) {
    const float sum = u + v;
    u /= sum;
    v /= sum;
  }
  Vec3f n =
      ((1 - u - v) * t.weight[0]) * t.normal[0] + (u * t.weight[1]) * t.normal[1] + (v * t.weight[2]) * t.normal[2];
  n.z = -n.z;  // the view frame's z points away from the eye, that of SurfacePoint towards it
  SurfacePoint point{normalized(n), direction_to_eye(view, x, y)};
  if (dot(point.normal, point.to_eye) < 0) point.normal = -point.normal;
  return point;
}

LinearColor shaded(LinearColor surface, const SurfacePoint& point) {
  const Vec3f n = point.normal;
  const float light = kAmbient + kSkyLight * (0.5f + 0.5f * n.y) + kKeyLight * std::max(0.0f, dot(n, kKeyDirection)) +
                      kFillLight * std::max(0.0f, dot(n, kFillDirection));
  const float mirror = std::max(0.0f, dot(n, normalized(kKeyDirection + point.to_eye)));
  const float mirror_4 = mirror * mirror * mirror * mirror, mirror_16 = mirror_4 * mirror_4 * mirror_4 * mirror_4;
  const float highlight = kHighlight * mirror_16 * mirror_16;
  return light * surface + Vec3f{highlight, highlight, highlight};
}

float apparent_opacity(float opacity, const SurfacePoint& point) {
  const float facing = std::clamp(dot(point.normal, point.to_eye), 0.0f, 1.0f);
  const float rim = 1 - facing;
  return opacity + (1 - opacity) * 0.45f * rim * rim * rim;
}

}  // namespace dismantle
