// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/bearing.h"
#include "samples/generator/fastener.h"
#include "samples/generator/gear.h"
#include "samples/generator/lathe_parts.h"

#include <cmath>

namespace dismantle::samples::lathe {
namespace {

constexpr double kHeadTop = 370, kHalfHead = 95, kFloor = 185;
constexpr double kLayY = 42, kLayZ = 224;  ///< The layshaft, 70 mm from the spindle.
constexpr double kMotorY = kLayY + 140;    ///< The motor's shaft, at the layshaft's height.
constexpr double kPulleyLow = -505, kPulleyHigh = -485, kPulleyRadius = 40;
constexpr double kFlangeBack = -206, kChuckBack = -192, kChuckFront = -130;
const GearShape kSpindleGear{2, 40, 0.15}, kLayGear{2, 30, 0.15};
const TaperedBearing kFront{60, 95, 23, 10}, kRear{50, 85, 22, 10};
const BallBearing kLayBearing{20, 42, 12, 7};

Placement lay_axis(double x) {
  return at(x, kLayY, kLayZ) * along_x();
}
Placement motor_axis(double x) {
  return at(x, kMotorY, kLayZ) * along_x();
}
std::vector<Placement> chuck_screws(double z) {
  return around_z(3, 108, z, 60);
}
std::vector<Placement> lid_screws(double z) {
  return at_corners(204, 174, z);
}

void add_housing(SampleModel& model, GroupId group) {
  const double middle = (kHeadBack + kHeadFront) / 2;
  std::vector<Solid> cuts{block({kHeadBack + 30, -78, kFloor}, {kHeadFront - 30, 78, kHeadTop + 1}),
                          vee(-500, -100),
                          rod(95, -25, 1).placed(spindle_axis(kHeadFront)),
                          rod(75, -40, 1).placed(spindle_axis(kHeadFront)),
                          rod(85, -1, 26).placed(spindle_axis(kHeadBack)),
                          rod(66, -1, 40).placed(spindle_axis(kHeadBack)),
                          rod(42, 8, 40).placed(lay_axis(kHeadBack)),
                          rod(24, -1, 40).placed(lay_axis(kHeadBack)),
                          rod(42, -40, -8).placed(lay_axis(kHeadFront)),
                          tapped_hole(10, 16).placed(at(-300, kHalfHead, 190) * along_y()),
                          tapped_hole(10, 16).placed(at(-380, kHalfHead, 190) * along_y()),
                          rod(9.98, -1, 20).placed(at(kHeadBack, idler_place().Y(), idler_place().Z()) * along_x())};
  for (const double x : {-400.0, -260.0}) {
    cuts.push_back(rod(9, 150, kFloor + 1).placed(at(x, 54, 0)));
    cuts.push_back(rod(9, 150, kFloor + 1).placed(at(x, -64.5, 0)));
  }
  for (const Placement& place : lid_screws(kHeadTop))
    cuts.push_back(tapped_hole(6, 15).placed(at(middle, 0, 0) * place));
  const Solid body = block({kHeadBack, -kHalfHead, kWays}, {kHeadFront, kHalfHead, kHeadTop});
  model.add(group, "headstock", body - cuts, kMachineGreen);
  const ProductId screw = model.product("headstock screw M8x45", cap_screw(8, 45), kBlackOxide);
  for (const double x : {-400.0, -260.0})
    for (const double y : {-64.5, 54.0}) model.place(group, screw, at(x, y, kFloor));
  const Solid lid = block({kHeadBack, -kHalfHead, kHeadTop}, {kHeadFront, kHalfHead, kHeadTop + 10}) -
                    at_each(rod(6.6, 360, 390), [&] {
                      std::vector<Placement> places;
                      for (const Placement& place : lid_screws(0)) places.push_back(at(middle, 0, 0) * place);
                      return places;
                    }());
  model.add(group, "headstock lid", lid, kMachineGreen);
  const ProductId lid_screw = model.product("lid screw M6x22", cap_screw(6, 22), kSteel);
  for (const Placement& place : lid_screws(kHeadTop + 10)) model.place(group, lid_screw, at(middle, 0, 0) * place);
}

void add_spindle(SampleModel& model, GroupId group) {
  const Solid outside = revolved({{13, -475},
                                  {20, -475},
                                  {20, -450},
                                  {22, -450},
                                  {22, -436},
                                  {25, -436},
                                  {25, -412},
                                  {28, -412},
                                  {28, -245},
                                  {30, -245},
                                  {30, -222},
                                  {36, -222},
                                  {36, kFlangeBack},
                                  {65, kFlangeBack},
                                  {65, kChuckBack},
                                  {13, kChuckBack}});
  std::vector<Solid> cuts;
  for (const Placement& place : chuck_screws(kChuckBack)) cuts.push_back(tapped_hole(8, 12).placed(place));
  model.add(group, "spindle", outside - cuts, kBrightSteel, spindle_axis(0));
  const BearingProducts front = make_tapered_bearing(model, "front bearing", kFront);
  place_bearing(model, group, front, at(-222, 0, kAxis) * turn_y(-90));
  const BearingProducts rear = make_tapered_bearing(model, "rear bearing", kRear);
  place_bearing(model, group, rear, spindle_axis(-436));
  model.add(group, "spindle nut", prism(8, 56, 0, 10) - rod(44 - kThreadOverlap, -1, 11), kSteel, spindle_axis(-446));
  const double angle = std::atan2(kLayY, kAxis - kLayZ) * 180 / 3.14159265358979323846;
  model.add(group, "spindle gear", spur_gear(kSpindleGear, 0, 20) - rod(55.97, -1, 21), kSteel,
            spindle_axis(-352) * turn_z(angle));
}

void add_layshaft(SampleModel& model, GroupId group) {
  const double angle = std::atan2(kLayY, kAxis - kLayZ) * 180 / 3.14159265358979323846;
  model.add(group, "layshaft", rod(19.98, -507, -229), kBrightSteel, lay_axis(0));
  model.add(group, "layshaft gear", spur_gear(kLayGear, 0, 20) - rod(19.95, -1, 21), kSteel,
            lay_axis(-352) * turn_z(meshing_turn(kSpindleGear, angle, kLayGear, angle)));
  const BearingProducts bearing = make_ball_bearing(model, "layshaft bearing", kLayBearing);
  model.add(group, "layshaft bush", tube(42.03, 20.04, -432, -412), kBronze, lay_axis(0));
  place_bearing(model, group, bearing, lay_axis(-240));
}

void add_drive(SampleModel& model, GroupId group) {
  const Solid rim = rod(2 * kPulleyRadius, kPulleyLow, kPulleyHigh);
  const ProductId pulley = model.product("pulley", rim - rod(19.95, -600, 0), kAluminium);
  model.place(group, pulley, lay_axis(0));
  model.place(group, pulley, motor_axis(0));
  auto loop = [](double radius, double z0, double z1) {
    const double length = kMotorY - kLayY;
    return rod(2 * radius, z0, z1) + std::vector<Solid>{rod(2 * radius, z0, z1).placed(at(0, length, 0)),
                                                        block({-radius, 0, z0}, {radius, length, z1})};
  };
  model.add(group, "drive belt", loop(kPulleyRadius + 4, 3, 17) - loop(kPulleyRadius, 2, 18), kRubber,
            lay_axis(kPulleyLow));
  const Solid motor =
      rod(120, -440, -270) + std::vector<Solid>{rod(60, -450, -439), rod(19.98, -507, -430),
                                                block({-30, -20, -400}, {30, 20, -300}).placed(at(-58, 0, 0))};
  const Solid bracket = block({-420, kHalfHead, 170}, {-280, kMotorY, 270}) -
                        std::vector<Solid>{rod(120, -500, -200).placed(motor_axis(0)),
                                           block({-430, kHalfHead + 15, 226}, {-270, 300, 300}),
                                           rod(11, -1, 70).placed(at(-300, kHalfHead, 190) * along_y()),
                                           rod(11, -1, 70).placed(at(-380, kHalfHead, 190) * along_y()),
                                           rod(20, 15, 100).placed(at(-300, kHalfHead, 190) * along_y()),
                                           rod(20, 15, 100).placed(at(-380, kHalfHead, 190) * along_y())};
  model.add(group, "motor", motor, kBlue, motor_axis(0));
  model.add(group, "motor bracket", bracket, kMachineGreen);
  const ProductId screw = model.product("bracket screw M10x30", cap_screw(10, 30), kBlackOxide);
  for (const double x : {-300.0, -380.0}) model.place(group, screw, at(x, kHalfHead + 15, 190) * along_y());
}

/// A wound band, `turns` times around, between two Archimedean spirals.
Solid scroll_ridge(double inner, double pitch, double turns, double width, double z0, double z1) {
  constexpr int kStepsPerTurn = 24;
  const int steps = static_cast<int>(turns * kStepsPerTurn);
  Outline outline;
  auto add = [&](int step, double offset) {
    const double angle = 2 * 3.14159265358979323846 * step / kStepsPerTurn;
    const double radius = inner + pitch * step / kStepsPerTurn + offset;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  for (int i = 0; i <= steps; ++i) add(i, 0);
  for (int i = steps; i >= 0; --i) add(i, width);
  return extruded(outline, z0, z1);
}

}  // namespace

void add_headstock(SampleModel& model) {
  const GroupId group = model.group("headstock");
  add_housing(model, group);
  add_spindle(model, group);
  add_layshaft(model, group);
  add_drive(model, group);
}

void add_chuck(SampleModel& model) {
  const GroupId group = model.group("chuck");
  constexpr double kScrollPitch = 8, kRidge = 3.4, kScrollInner = 22, kScrollFace = -172, kFootFront = -156;
  std::vector<Solid> cuts{rod(42, -300, 0), rod(84.1, kChuckBack - 1, kScrollFace)};
  for (const Placement& place : around_z(3, 0)) {
    cuts.push_back(block({0, -15, kScrollFace}, {90, 15, kFootFront}).placed(place));
    cuts.push_back(block({0, -10, kFootFront - 1}, {90, 10, kChuckFront + 1}).placed(place));
  }
  for (const Placement& place : chuck_screws(kChuckFront)) cuts.push_back(cap_screw_counterbore(8, 70).placed(place));
  model.add(group, "chuck body", rod(170, kChuckBack, kChuckFront) - cuts, kToolSteel, spindle_axis(0));
  const ProductId screw = model.product("chuck screw M8x64", cap_screw(8, 64), kBlackOxide);
  for (const Placement& place : chuck_screws(kChuckFront - 8.4)) model.place(group, screw, spindle_axis(0) * place);
  const Solid scroll = tube(84, 42, kChuckBack + 0.05, kScrollFace - 8) +
                       scroll_ridge(kScrollInner, kScrollPitch, 2, kRidge, kScrollFace - 9, kScrollFace - 0.1);
  model.add(group, "scroll", scroll, kSteel, spindle_axis(0));

  for (int i = 0; i < 3; ++i) {
    // One tooth of each jaw stands in the middle of the scroll's gap at the jaw's angle.
    const double gap = kScrollPitch - kRidge, tooth = kScrollInner + kScrollPitch * i / 3 + kRidge + gap / 2;
    const Solid jaw =
        block({24, -14.97, kScrollFace + 0.03}, {72, 14.97, kFootFront - 0.03}) +
        std::vector<Solid>{block({24, -9.97, kFootFront - 1}, {72, 9.97, -124}),
                           block({kBarRadius, -9.97, -124.5}, {46, 9.97, -98}),
                           block({tooth - 1.3, -5, kScrollFace - 7.5}, {tooth + 1.3, 5, kScrollFace + 1})};
    model.add(group, "jaw " + std::to_string(i + 1), jaw, kBrightSteel, spindle_axis(0) * turn_z(120.0 * i));
  }
  model.add(group, "workpiece", rod(2 * kBarRadius, -185, kBarEnd), kBrass, spindle_axis(0));
}

}  // namespace dismantle::samples::lathe
