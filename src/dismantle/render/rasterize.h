// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/render/project_scene.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

/// A half-open rectangle of samples: [x0, x1) by [y0, y1).
struct SampleRect {
  int x0 = 0;  ///< First column.
  int y0 = 0;  ///< First row.
  int x1 = 0;  ///< Column after the last.
  int y1 = 0;  ///< Row after the last.

  int width() const { return x1 - x0; }   ///< [samples]
  int height() const { return y1 - y0; }  ///< [samples]
};

/// A half-open range of sample indices.
struct SampleRange {
  int first = 0;  ///< First index.
  int last = 0;   ///< Index after the last.
};

/// The samples n in [low, high) whose centre n + 1/2 lies in [from, to).
inline SampleRange sample_range(double from, double to, int low, int high) {
  const double first = std::ceil(std::clamp(from, low - 1.0, high + 1.0) - 0.5);
  const double last = std::ceil(std::clamp(to, low - 1.0, high + 1.0) - 0.5);
  return {std::max(low, static_cast<int>(first)), std::min(high, static_cast<int>(last))};
}

/// Calls visit(x, y, key) for each sample of `rect` whose centre the triangle covers. Triangles that share an edge
/// leave no gap and cover no sample twice: the crossing of a row with an edge depends on the edge alone.
template <class Visit>
void rasterize_triangle(const ScreenTriangle& t, const SampleRect& rect, const Visit& visit) {
  const double x0 = t.x[0], y0 = t.y[0], k0 = t.key[0];
  const double ax = t.x[1] - x0, ay = t.y[1] - y0, bx = t.x[2] - x0, by = t.y[2] - y0;
  const double area = ax * by - bx * ay;
  if (area == 0) return;
  const double ka = t.key[1] - k0, kb = t.key[2] - k0;
  const double key_dx = (ka * by - kb * ay) / area, key_dy = (kb * ax - ka * bx) / area;
  const auto [nearest, farthest] = std::minmax({t.key[0], t.key[1], t.key[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});

  struct Edge {
    double x, y, end_y, slope;
  } edges[3];
  for (int k = 0; k < 3; ++k) {
    int p = k, q = (k + 1) % 3;
    if (t.y[q] < t.y[p] || (t.y[q] == t.y[p] && t.x[q] < t.x[p])) std::swap(p, q);
    const double rise = static_cast<double>(t.y[q]) - t.y[p];
    edges[k] = {t.x[p], t.y[p], t.y[q], rise > 0 ? (static_cast<double>(t.x[q]) - t.x[p]) / rise : 0};
  }

  const SampleRange rows = sample_range(top, bottom, rect.y0, rect.y1);
  for (int y = rows.first; y < rows.last; ++y) {
    const double yc = y + 0.5;
    double left = 1e300, right = -1e300;
    for (const Edge& e : edges) {
      if (yc < e.y || yc >= e.end_y) continue;
      const double x = e.x + e.slope * (yc - e.y);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const SampleRange columns = sample_range(left, right, rect.x0, rect.x1);
    for (int x = columns.first; x < columns.last; ++x) {
      const double key = k0 + key_dx * (x + 0.5 - x0) + key_dy * (yc - y0);
      visit(x, y, std::clamp(static_cast<float>(key), nearest, farthest));
    }
  }
}

/// Calls visit(x, y, key) for each sample of `rect` within half the line's width of the line.
template <class Visit>
void rasterize_line(const ScreenLine& line, const SampleRect& rect, const Visit& visit) {
  const float w = line.half_width;
  const float dx = line.x[1] - line.x[0], dy = line.y[1] - line.y[0];
  const float length_squared = dx * dx + dy * dy;
  const auto [left, right] = std::minmax(line.x[0], line.x[1]);
  const auto [top, bottom] = std::minmax(line.y[0], line.y[1]);
  const SampleRange rows = sample_range(top - w, bottom + w, rect.y0, rect.y1);
  for (int y = rows.first; y < rows.last; ++y) {
    const float py = static_cast<float>(y) + 0.5f - line.y[0];
    double from = left - w, to = right + w;
    if (std::abs(dy) > 1e-3f * std::abs(dx)) {  // limit the row to the band around the infinite line
      const double center = line.x[0] + static_cast<double>(py) * dx / dy;
      const double reach = w * std::sqrt(length_squared) / std::abs(dy);
      from = std::max(from, center - reach);
      to = std::min(to, center + reach);
    }
    const SampleRange columns = sample_range(from, to, rect.x0, rect.x1);
    for (int x = columns.first; x < columns.last; ++x) {
      const float px = static_cast<float>(x) + 0.5f - line.x[0];
      const float s = length_squared > 0 ? std::clamp((px * dx + py * dy) / length_squared, 0.0f, 1.0f) : 0.0f;
      const float ox = px - s * dx, oy = py - s * dy;
      if (ox * ox + oy * oy <= w * w) visit(x, y, line.key[0] + s * (line.key[1] - line.key[0]));
    }
  }
}

}  // namespace dismantle
