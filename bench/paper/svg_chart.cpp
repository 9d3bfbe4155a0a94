// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/svg_chart.h"

#include "dismantle/core/contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dismantle {

namespace {

constexpr double kWidth = 760, kHeight = 420, kLeft = 70, kRight = 190, kTop = 40, kBottom = 56;  // [px]
constexpr double kPlotWidth = kWidth - kLeft - kRight, kPlotHeight = kHeight - kTop - kBottom;
// Okabe and Ito's colours.
constexpr const char* kColors[kChartColors] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                               "#56b4e9", "#d55e00", "#000000"};

/// A logarithmic axis over whole decades.
class LogAxis {
 public:
  LogAxis(double min, double max)
      : low_(std::floor(std::log10(min) + 1e-9)), high_(std::max(low_ + 1, std::ceil(std::log10(max) - 1e-9))) {}

  /// The position of a value along the axis, in [0, 1].
  double position(double value) const { return (std::log10(value) - low_) / (high_ - low_); }
  /// The decades.
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (double e = low_; e <= high_ + 0.5; ++e) values.push_back(std::pow(10, e));
    return values;
  }

 private:
  double low_, high_;
};

struct Range {
  double min = 1e300, max = 1e-300;
  void extend(double value) {
    DISMANTLE_EXPECT(value > 0);
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

double x_at(double position) {
  return kLeft + position * kPlotWidth;
}

double y_at(double position) {
  return kTop + (1 - position) * kPlotHeight;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& color) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                     color);
}

/// The beginning of a chart: background, title and vertical axis.
std::string head(const std::string& title, const std::string& y_label, const LogAxis& y_axis) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      kWidth, kHeight);
  svg += text_at(kLeft, 22, "start", title);
  for (const double tick : y_axis.ticks()) {
    const double y = y_at(y_axis.position(tick));
    svg += line(kLeft, y, kLeft + kPlotWidth, y, "#dddddd");
    svg += text_at(kLeft - 6, y + 4, "end", fmt::format("{:g}", tick));
  }
  svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     y_at(0.5), y_label);
  return svg;
}

/// The names of the series beside their colours.
std::string legend(const std::vector<ChartSeries>& series) {
  std::string svg;
  for (std::size_t s = 0; s < series.size(); ++s) {
    const double y = kTop + 10 + 18 * static_cast<double>(s), x = kLeft + kPlotWidth + 16;
    svg +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"10\" height=\"10\" fill=\"{}\"/>\n", x, y - 9, kColors[s]);
    svg += text_at(x + 16, y, "start", series[s].name);
  }
  return svg;
}

}  // namespace

std::string svg_of(const LineChart& chart) {
  DISMANTLE_EXPECT(chart.series.size() <= kChartColors);
  Range xs, ys;
  for (const ChartSeries& series : chart.series) {
    for (const double x : series.x) xs.extend(x);
    for (const double y : series.y) ys.extend(y);
  }
  const LogAxis x_axis(xs.min, xs.max), y_axis(ys.min, ys.max);
  std::string svg = head(chart.title, chart.y_label, y_axis);
  for (const double tick : x_axis.ticks()) {
    const double x = x_at(x_axis.position(tick));
    svg += line(x, y_at(0), x, y_at(1), "#dddddd");
    svg += text_at(x, y_at(0) + 18, "middle", fmt::format("{:L}", static_cast<long long>(std::llround(tick))));
  }
  svg += text_at(x_at(0.5), kHeight - 12, "middle", chart.x_label);
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const ChartSeries& series = chart.series[s];
    std::string points;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const double x = x_at(x_axis.position(series.x[i])), y = y_at(y_axis.position(series.y[i]));
      points += fmt::format("{:.1f},{:.1f} ", x, y);
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", x, y, kColors[s]);
    }
    svg +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", points, kColors[s]);
  }
  return svg + legend(chart.series) + "</svg>\n";
}

std::string svg_of(const BarChart& chart) {
  DISMANTLE_EXPECT(chart.series.size() <= kChartColors);
  Range ys;
  ys.extend(1);
  for (const ChartSeries& series : chart.series)
    for (const double y : series.y) ys.extend(y);
  const LogAxis y_axis(ys.min, ys.max);
  std::string svg = head(chart.title, chart.y_label, y_axis);
  const double group_width = kPlotWidth / static_cast<double>(chart.groups.size());
  const double bar_width = 0.8 * group_width / static_cast<double>(chart.series.size());
  const double base = y_at(y_axis.position(1));
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    const double left = kLeft + group_width * (static_cast<double>(g) + 0.1);
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
      const double value = y_at(y_axis.position(chart.series[s].y[g]));
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                         left + bar_width * static_cast<double>(s), std::min(base, value), bar_width - 1,
                         std::abs(value - base), kColors[s]);
    }
    std::istringstream words(chart.groups[g]);
    double y = y_at(0) + 18;
    for (std::string word; words >> word; y += 15) svg += text_at(left + 0.4 * group_width, y, "middle", word);
  }
  svg += line(kLeft, base, kLeft + kPlotWidth, base, "#000000");
  return svg + legend(chart.series) + "</svg>\n";
}

}  // namespace dismantle
