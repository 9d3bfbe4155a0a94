// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dismantle {

/// Values under one name and in one colour.
struct ChartSeries {
  std::string name;
  std::vector<double> x;  ///< Of a line chart; as long as `y`.
  std::vector<double> y;
};

/// Lines between marked points, both axes logarithmic.
struct LineChart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;  ///< At most kChartColors; all values > 0.
};

/// Groups of bars side by side, from 1 upwards or downwards on a logarithmic axis.
struct BarChart {
  std::string title, y_label;
  std::vector<std::string> groups;  ///< Their names; a line for each word.
  std::vector<ChartSeries> series;  ///< At most kChartColors; a value > 0 a group.
};

/// How many series a chart can tell apart, by colours that the colour-blind can tell apart, too.
inline constexpr std::size_t kChartColors = 7;

/// A chart as the text of an SVG file.
std::string svg_of(const LineChart& chart);
std::string svg_of(const BarChart& chart);

}  // namespace dismantle
