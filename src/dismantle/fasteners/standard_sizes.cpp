// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/standard_sizes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dismantle {

namespace {

// diameter, pitch, hexagon, DIN, cylinder head, key, button head, key, set screw key, pan head, cross, washer, hole
constexpr ThreadSize kSizes[] = {
    {1, 0.25, 2.5, 0, 0, 0, 0, 0, 0, 0, 0, 2.5, 1.1},        {1.2, 0.25, 3, 0, 0, 0, 0, 0, 0, 0, 0, 3, 1.3},
    {1.4, 0.3, 3, 0, 2.6, 1.3, 0, 0, 0.7, 0, 0, 3, 1.5},     {1.6, 0.35, 3.2, 0, 3, 1.5, 0, 0, 0.7, 3.2, 0, 4, 1.7},
    {2, 0.4, 4, 0, 3.8, 1.5, 3.5, 1.3, 0.9, 4, 0, 5, 2.2},   {2.5, 0.45, 5, 0, 4.5, 2, 4.7, 1.5, 1.3, 5, 1, 6, 2.7},
    {3, 0.5, 5.5, 0, 5.5, 2.5, 5.7, 2, 1.5, 5.6, 1, 7, 3.2}, {3.5, 0.6, 6, 0, 6, 0, 0, 0, 0, 7, 2, 8, 3.7},
    {4, 0.7, 7, 0, 7, 3, 7.6, 2.5, 2, 8, 2, 9, 4.3},         {5, 0.8, 8, 0, 8.5, 4, 9.5, 3, 2.5, 9.5, 2, 10, 5.3},
    {6, 1, 10, 0, 10, 5, 10.5, 4, 3, 12, 3, 12, 6.4},        {7, 1, 11, 0, 0, 0, 0, 0, 0, 0, 0, 14, 7.4},
    {8, 1.25, 13, 0, 13, 6, 14, 5, 4, 16, 4, 16, 8.4},       {10, 1.5, 16, 17, 16, 8, 17.5, 6, 5, 20, 4, 20, 10.5},
    {12, 1.75, 18, 19, 18, 10, 21, 8, 6, 0, 0, 24, 13},      {14, 2, 21, 22, 21, 12, 0, 0, 6, 0, 0, 28, 15},
    {16, 2, 24, 0, 24, 14, 28, 10, 8, 0, 0, 30, 17},         {18, 2.5, 27, 0, 27, 14, 0, 0, 0, 0, 0, 34, 19},
    {20, 2.5, 30, 0, 30, 17, 0, 0, 10, 0, 0, 37, 21},        {22, 2.5, 34, 32, 33, 17, 0, 0, 0, 0, 0, 39, 23},
    {24, 3, 36, 0, 36, 19, 0, 0, 12, 0, 0, 44, 25},          {27, 3, 41, 0, 40, 19, 0, 0, 0, 0, 0, 50, 28},
    {30, 3.5, 46, 0, 45, 22, 0, 0, 0, 0, 0, 56, 31},         {33, 3.5, 50, 0, 0, 0, 0, 0, 0, 0, 0, 60, 34},
    {36, 4, 55, 0, 54, 27, 0, 0, 0, 0, 0, 66, 37},           {39, 4, 60, 0, 0, 0, 0, 0, 0, 0, 0, 72, 42},
    {42, 4.5, 65, 0, 63, 32, 0, 0, 0, 0, 0, 78, 45},         {48, 5, 75, 0, 72, 36, 0, 0, 0, 0, 0, 92, 52},
    {56, 5.5, 85, 0, 84, 41, 0, 0, 0, 0, 0, 105, 62},        {64, 6, 95, 0, 96, 46, 0, 0, 0, 0, 0, 115, 70},
};

struct Torx {
  double number, outer;
};
constexpr Torx kTorx[] = {{5, 1.45},  {6, 1.72},  {7, 2.06},  {8, 2.39},  {9, 2.57},  {10, 2.82},
                          {15, 3.35}, {20, 3.94}, {25, 4.52}, {27, 5.07}, {30, 5.61}, {40, 6.76},
                          {45, 7.93}, {50, 8.95}, {55, 11.3}, {60, 13.4}};

/// A circlip for a shaft: the shaft's diameter and the inner diameter of the circlip when it is off it.
struct Circlip {
  double shaft, inner;
};
constexpr Circlip kCirclips[] = {{3, 2.7},   {4, 3.7},   {5, 4.7},   {6, 5.6},   {7, 6.5},   {8, 7.4},   {9, 8.4},
                                 {10, 9.3},  {11, 10.2}, {12, 11},   {13, 11.9}, {14, 12.9}, {15, 13.8}, {16, 14.7},
                                 {17, 15.7}, {18, 16.5}, {19, 17.5}, {20, 18.5}, {21, 19.5}, {22, 20.5}, {24, 22.2},
                                 {25, 23.2}, {26, 24.2}, {28, 25.9}, {30, 27.9}, {32, 29.6}, {35, 32.2}, {38, 35.2},
                                 {40, 36.5}, {42, 38.5}, {45, 41.5}, {50, 45.8}, {55, 50.8}, {60, 55.8}, {65, 60.8},
                                 {70, 65.5}, {75, 70.5}, {80, 74.5}, {85, 79.5}, {90, 84.5}, {95, 89.5}, {100, 94.5}};

constexpr double kDowels[] = {0.6, 0.8, 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 13, 14, 16, 20, 25, 30};
constexpr double kDowelLengths[] = {2,  3,  4,  5,  6,  8,  10, 12, 14, 16, 18, 20, 22, 24,  26,  28,  30,  32, 35,
                                    36, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 110, 120, 140, 160};
constexpr double kInch = 25.4;
/// In sixteenths of an inch, but for 3/32 and 5/32.
constexpr double kInchDowels[] = {1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 10, 12};

constexpr double kWidths[] = {0.7, 0.9, 1.3, 1.5, 2,  2.5, 3,  3.2, 4,  5,  5.5, 6,  7,  8,  9,  10,
                              11,  12,  13,  14,  15, 16,  17, 18,  19, 20, 21,  22, 24, 27, 30, 32,
                              34,  36,  41,  46,  50, 55,  60, 65,  70, 75, 80,  85, 90, 95};

template <std::size_t kCount>
double nearest_within(const double (&values)[kCount], double value, double share) {
  const double best = *std::min_element(std::begin(values), std::end(values),
                                        [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
  return std::abs(best - value) <= share * best ? best : 0;
}

}  // namespace

Span<const ThreadSize> thread_sizes() {
  return Span<const ThreadSize>(kSizes, std::size(kSizes));
}

const ThreadSize* thread_size(double diameter) {
  for (const ThreadSize& size : kSizes)
    if (std::abs(size.diameter - diameter) <= 0.01 * diameter) return &size;
  return nullptr;
}

double torx_number(double outer_diameter) {
  const Torx* best = std::min_element(std::begin(kTorx), std::end(kTorx), [&](const Torx& a, const Torx& b) {
    return std::abs(a.outer - outer_diameter) < std::abs(b.outer - outer_diameter);
  });
  return std::abs(best->outer - outer_diameter) <= 0.08 * best->outer ? best->number : 0;
}

double circlip_shaft(double inner_diameter) {
  // Off its shaft it is as in the table, in its groove a little wider.
  double best = 0;
  for (const Circlip& c : kCirclips)
    if (inner_diameter >= 0.97 * c.inner && inner_diameter <= c.shaft) best = c.shaft;
  return best;
}

double dowel_diameter(double diameter) {
  if (const double metric = nearest_within(kDowels, diameter, 0.01); metric > 0) return metric;
  return nearest_within(kInchDowels, diameter * 16 / kInch, 0.01) * kInch / 16;
}

bool is_dowel_length(double diameter, double length) {
  if (nearest_within(kDowels, diameter, 1e-6) > 0) return nearest_within(kDowelLengths, length, 0.01) > 0;
  const double sixteenths = length * 16 / kInch;
  return std::abs(sixteenths - std::round(sixteenths)) <= 0.05;
}

double nominal_width(double across_flats) {
  const double nominal = nearest_within(kWidths, across_flats, 0.03);
  return nominal > 0 ? nominal : across_flats;
}

}  // namespace dismantle
