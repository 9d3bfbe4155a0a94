// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dismantle {

/// Named values that are drawn in one colour.
struct ChartSeries {
  std::string name;
  std::vector<double> x;  ///< Of a line chart; as long as `y`.
  std::vector<double> y;
};

/// Line chart with marked points, both axes logarithmic.
struct LineChart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;  ///< At most kChartColors; all values > 0.
};

/// Grouped bar chart; bars start at 1 on a logarithmic axis.
struct BarChart {
  std::string title, y_label;
  std::vector<std::string> groups;  ///< Their names; a line for each word.
  std::vector<ChartSeries> series;  ///< At most kChartColors; a value > 0 a group.
};

/// The number of series that a chart can distinguish, by colours that colour-blind readers can distinguish too.
inline constexpr std::size_t kChartColors = 7;

/// The chart as the text of an SVG file.
std::string svg_of(const LineChart& chart);
std::string svg_of(const BarChart& chart);

}  // namespace dismantle
