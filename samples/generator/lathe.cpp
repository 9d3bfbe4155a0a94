// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/fastener.h"
#include "samples/generator/gear.h"
#include "samples/generator/lathe_parts.h"
#include "samples/generator/samples.h"

#include <cmath>

namespace dismantle::samples {
namespace lathe {
namespace {

const GearShape kSpindleChange{2, 36, 0.15}, kIdler{2, 53, 0.15}, kLeadChange{2, 45, 0.15};
constexpr double kChangeLow = -470, kChangeHigh = -455;

/// Direction in the gears' own frame (along_x takes x to -z and y to y) [degrees].
double direction(double dy, double dz) {
  return std::atan2(dy, -dz) * 180 / 3.14159265358979323846;
}

}  // namespace

gp_XYZ idler_place() {
  const double to_spindle = (pitch_diameter(kSpindleChange) + pitch_diameter(kIdler)) / 2 + 0.02;
  const double to_lead = (pitch_diameter(kLeadChange) + pitch_diameter(kIdler)) / 2 + 0.02;
  const double dy = kLeadY, dz = kLeadZ - kAxis, distance = std::hypot(dy, dz);
  const double along = (to_spindle * to_spindle - to_lead * to_lead + distance * distance) / (2 * distance);
  const double across = std::sqrt(to_spindle * to_spindle - along * along);
  return {0, (along * dy + across * dz) / distance, kAxis + (along * dz - across * dy) / distance};
}

Solid vee(double x0, double x1) {
  return extruded({{-58, kWays - 2}, {-42, kWays - 2}, {-50, kWays + 6}}, x0, x1).placed(side_view());
}

void add_bed(SampleModel& model) {
  const GroupId group = model.group("bed");
  const Solid rails = extruded({{-70, kBedLow},
                                {70, kBedLow},
                                {70, kWays},
                                {35, kWays},
                                {35, 110},
                                {-35, 110},
                                {-35, kWays - 2},
                                {-42, kWays - 2},
                                {-50, kWays + 6},
                                {-58, kWays - 2},
                                {-70, kWays - 2}},
                               -450, 450)
                          .placed(side_view());
  std::vector<Solid> cuts;
  for (const double x : {-400.0, -260.0}) {
    cuts.push_back(tapped_hole(8, 25).placed(at(x, 54, kWays)));
    cuts.push_back(tapped_hole(8, 25).placed(at(x, -64.5, kWays - 2)));
  }
  const std::vector<double> feet{-340, 340};
  for (const double x : feet)
    for (const double y : {-50.0, 50.0}) cuts.push_back(tapped_hole(12, 22).placed(at(x, y, kBedLow) * turn_x(180)));
  for (const double x : {-207.0, 432.0})
    for (const double z : {100.0, 148.0}) cuts.push_back(tapped_hole(6, 15).placed(at(x, -70, z) * turn_x(90)));
  model.add(group, "bed", rails - cuts, kMachineGreen);
  const Solid pedestal = block({-100, -85, 0}, {100, 85, kBedLow}) -
                         std::vector<Solid>{block({-80, -90, -1}, {80, 65, 62}), rod(13, 50, 90).placed(at(0, 50, 0)),
                                            rod(13, 50, 90).placed(at(0, -50, 0))};
  const ProductId stand = model.product("pedestal", pedestal, kMachineGreen);
  const ProductId screw = model.product("pedestal screw M12x36", hex_screw(12, 36), kSteel);
  for (const double x : feet) {
    model.place(group, stand, at(x, 0, 0));
    for (const double y : {-50.0, 50.0}) model.place(group, screw, at(x, y, 62) * turn_x(180));
  }
}

void add_feed(SampleModel& model) {
  const GroupId group = model.group("feed");
  const Solid screw = threaded_rod(lead_thread(), -472, 445, 372, 90);
  model.add(group, "lead screw threaded", screw, kBrightSteel, lead_axis(0));
  const Solid bracket = block({-12, -118, 92}, {12, -70, 156}) -
                        std::vector<Solid>{rod(13.76, -20, 20).placed(lead_axis(0)),
                                           rod(6.6, -1, 60).placed(at(0, -119, 100) * along_y()),
                                           rod(6.6, -1, 60).placed(at(0, -119, 148) * along_y())};
  const ProductId brackets = model.product("lead screw bracket", bracket, kMachineGreen);
  const ProductId bracket_screw = model.product("bracket screw M6x60", cap_screw(6, 60), kBlackOxide);
  for (const double x : {-207.0, 432.0}) {
    model.place(group, brackets, at(x, 0, 0));
    for (const double z : {100.0, 148.0}) model.place(group, bracket_screw, at(x, -118, z) * turn_x(90));
  }
  const gp_XYZ idler = idler_place();
  auto gear = [&](const GearShape& shape, double bore) {
    return spur_gear(shape, 0, kChangeHigh - kChangeLow) - rod(bore, -1, 30);
  };
  const double turn = meshing_turn(kSpindleChange, 0, kIdler, direction(idler.Y(), idler.Z() - kAxis));
  const double lead_turn = meshing_turn(kIdler, turn, kLeadChange, direction(kLeadY - idler.Y(), kLeadZ - idler.Z()));
  model.add(group, "spindle change gear", gear(kSpindleChange, 39.97), kSteel, spindle_axis(kChangeLow));
  model.add(group, "idler gear", gear(kIdler, 20.05), kSteel,
            at(kChangeLow, idler.Y(), idler.Z()) * along_x() * turn_z(turn));
  model.add(group, "lead screw gear", gear(kLeadChange, 13.68), kSteel, lead_axis(kChangeLow) * turn_z(lead_turn));
  const Solid pin = rod(20, 0, 15) + std::vector<Solid>{rod(30, 15, 15 + 15), rod(12, -4, 1), rod(10, 29, 48)};
  model.add(group, "idler pin", pin, kSteel, at(kChangeLow, idler.Y(), idler.Z()) * along_x());
  model.add(group, "circlip 11", circlip(11, 3, 1.5), kBlackOxide,
            at(kChangeLow - 1.7, idler.Y(), idler.Z()) * along_x());
}

}  // namespace lathe

SampleModel make_lathe() {
  SampleModel model("lathe");
  lathe::add_bed(model);
  lathe::add_headstock(model);
  lathe::add_chuck(model);
  lathe::add_carriage(model);
  lathe::add_tailstock(model);
  lathe::add_feed(model);
  return model;
}

}  // namespace dismantle::samples
