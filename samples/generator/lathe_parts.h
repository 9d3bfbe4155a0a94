// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/sample_model.h"
#include "samples/generator/thread.h"

// Dimensions that the parts of the lathe share. The spindle's axis is x, the operator stands at -y, the floor is z = 0.
namespace dismantle::samples::lathe {

inline constexpr double kBedLow = 80, kWays = 160;  ///< Flat way's height; the V stands on it in front.
inline constexpr double kAxis = 280;                ///< Height of the spindle.
inline constexpr double kHeadBack = -440, kHeadFront = -220;
inline constexpr double kLeadY = -100, kLeadZ = 125;         ///< The lead screw.
inline constexpr double kSaddleLow = 60, kSaddleHigh = 200;  ///< Of the carriage, along x.
inline constexpr double kBarRadius = 20, kBarEnd = 230;      ///< The workpiece.

inline Placement spindle_axis(double x) {
  return at(x, 0, kAxis) * along_x();
}
inline Placement lead_axis(double x) {
  return at(x, kLeadY, kLeadZ) * along_x();
}
inline ThreadForm lead_thread() {
  return trapezoidal_thread(22, 10);
}

/// The idler of the change gears in (y, z): at meshing distance from the spindle and from the lead screw.
gp_XYZ idler_place();
/// The cut of the bed's V in a part that sits on the ways, between two positions along x.
Solid vee(double x0, double x1);

void add_bed(SampleModel& model);
void add_headstock(SampleModel& model);
void add_chuck(SampleModel& model);
void add_carriage(SampleModel& model);
void add_tailstock(SampleModel& model);
void add_feed(SampleModel& model);

}  // namespace dismantle::samples::lathe
