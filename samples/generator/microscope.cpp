// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/fastener.h"
#include "samples/generator/gear.h"
#include "samples/generator/samples.h"
#include "samples/generator/thread.h"

#include <cmath>

// A monocular laboratory microscope. The optical axis is z, the user sits at +y; the base stands on z = 0.
namespace dismantle::samples {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBaseTop = 24, kLampSeat = 8;
constexpr double kColumnFront = -60, kColumnBack = -105, kHalfColumn = 18;
constexpr double kLimbBottom = 250, kLimbTop = 286;
constexpr double kWayFront = -52;       ///< Front of the dovetail on the column.
constexpr double kWayClearance = 0.03;  ///< Between the dovetail and the carriage [mm].
constexpr double kCarriageFront = -37, kCarriageLow = 110, kPlatformTop = 156, kStageTop = 164;
constexpr double kTilt = 20;   ///< Of the turret, and of the objectives in it [degrees].
constexpr double kApex = 262;  ///< Height where the objectives' axes meet.
constexpr double kSeat = 55;   ///< From there to the objectives' seats.
constexpr double kPinionZ = 133;
constexpr double kArmScrewY = -82;
constexpr double kRackPitchY = -65;
const GearShape kRackGear{0.8, 16, 0.08};

double pinion_y() {
  return kRackPitchY - pitch_diameter(kRackGear) / 2;
}
Placement pinion_axis() {
  return at(0, pinion_y(), kPinionZ) * along_x();
}
Placement turret_frame() {
  return at(0, 0, kApex) * turn_x(kTilt);
}
Placement objective_place(int i) {
  return turn_z(-90 + 120.0 * i) * turn_y(-kTilt) * at(0, 0, -kSeat);
}
/// For a screw that stands on its head.
Placement upside_down(double x, double y, double z) {
  return at(x, y, z) * turn_x(180);
}
/// For a screw whose head faces the user.
Placement facing_user(double x, double y, double z) {
  return at(x, y, z) * along_y();
}

/// The dovetail, grown by `play`, over a height.
Solid dovetail(double play, double z0, double z1) {
  const double front = kWayFront + play, narrow = 11.5 + 1.5 * play, wide = narrow + 4 + play;
  return extruded({{-narrow, kColumnFront - 1},
                   {narrow, kColumnFront - 1},
                   {narrow, kColumnFront},
                   {wide, front},
                   {-wide, front},
                   {-narrow, kColumnFront}},
                  z0, z1);
}

void add_stand(SampleModel& model) {
  const GroupId group = model.group("stand");
  std::vector<Solid> cuts{rod(34.1, kLampSeat, kBaseTop + 1), block({-9, -104, -1}, {9, -61, 8})};
  cuts.push_back(rod(8.8, 7, 25).placed(at(0, kArmScrewY, 0)));
  model.add(group, "base", plate(112, 180, 8, 0, kBaseTop).placed(at(0, -32, 0)) - cuts, kCream);
  const ProductId foot = model.product("foot", block({-9, -9, -6}, {9, 9, 0}), kRubber);
  for (const Placement& corner : at_corners(84, 150)) model.place(group, foot, at(0, -32, 0) * corner);
  model.add(group, "arm screw M8x28", hex_screw(8, 28), kSteel, upside_down(0, kArmScrewY, 8));
}

void add_arm(SampleModel& model) {
  const Solid side = extruded({{kColumnBack, kBaseTop},
                               {kColumnFront, kBaseTop},
                               {kColumnFront, kLimbBottom, 24},
                               {20, kLimbBottom},
                               {20, kLimbTop},
                               {kColumnBack, kLimbTop, 70}},
                              -kHalfColumn, kHalfColumn)
                         .placed(side_view());
  const Solid body = side + std::vector<Solid>{rod(50, kLimbBottom, kLimbTop), dovetail(0, 96, 190)};
  const Placement pinion = pinion_axis();
  std::vector<Solid> cuts{block({-6.2, -68, 60}, {6.2, kWayFront + 1, 195}),
                          rod(8.06, -30, 0).placed(pinion),
                          rod(15.2, -8, 8).placed(pinion),
                          rod(16, 8, 30).placed(pinion),
                          rod(30.05, kLimbBottom - 1, kLimbTop + 1),
                          tapped_hole(4, 20).placed(facing_user(0, 27, 257)),
                          tapped_hole(4, 20).placed(facing_user(0, 27, 279))};
  cuts.push_back(tapped_hole(8, 16).placed(upside_down(0, kArmScrewY, kBaseTop)));
  model.add(model.group("arm"), "arm", body - cuts, kCream);
}

void add_lamp(SampleModel& model) {
  const GroupId group = model.group("lamp");
  model.add(group, "lamp", revolved({{0, kLampSeat}, {17, kLampSeat}, {17, 38}, {13, 38}, {13, 34}, {0, 34}}),
            kDarkGrey);
  model.add(group, "collector lens", rod(26.03, 34, 37), kGlass);
}

void add_focus_drive(SampleModel& model) {
  const GroupId group = model.group("focus drive");
  const Placement axis = pinion_axis();
  const Solid shaft = (rod(8, -40, 41) + spur_gear(kRackGear, -7, 7)) - std::vector<Solid>{tube(10, 7, -20.1, -18.9)};
  model.add(group, "pinion shaft", shaft, kBrightSteel, axis * turn_z(11.25));
  model.add(group, "circlip 7", circlip(6.4, 1.3, 1), kBlackOxide, axis * at(0, 0, -20));
  model.add(group, "pinion bush", tube(16.03, 8.06, 8, 21), kBronze, axis);

  const ProductId coarse_knob = model.product("coarse knob", ridged_knob({42, 16, 18, 7.98}), kBlackOxide);
  for (const Placement& side : {axis * at(0, 0, -40), axis * at(0, 0, 23)}) model.place(group, coarse_knob, side);
}

void add_carriage(SampleModel& model) {
  const GroupId group = model.group("focus carriage");
  const double back = kColumnFront + kWayClearance, channel = kWayFront + kWayClearance;
  std::vector<Solid> cuts{dovetail(kWayClearance, kCarriageLow - 1, kPlatformTop + 1)};
  for (const double z : {116.0, 150.0}) cuts.push_back(rod(3.3, -20, 0).placed(facing_user(0, kCarriageFront - 4, z)));
  cuts.push_back(block({-4, kCarriageFront - 4, kCarriageLow - 1}, {4, kCarriageFront + 1, kPlatformTop + 1}));
  for (const double x : {-13.0, 13.0}) cuts.push_back(tapped_hole(4, 10).placed(facing_user(x, kCarriageFront, 120)));
  model.add(group, "carriage", block({-20, back, kCarriageLow}, {20, kCarriageFront, kPlatformTop}) - cuts, kDarkGrey);

  const double pitch = kPi * kRackGear.module;
  const Placement rack_place = at(0, kRackPitchY, kPinionZ) * turn_z(-90) * turn_x(90) * at(0, -8 * pitch, 0);
  std::vector<Solid> taps;
  for (const double z : {116.0, 150.0}) taps.push_back(tapped_hole(3, 9).placed(facing_user(0, channel, z)));
  model.add(group, "rack", gear_rack(kRackGear, 17, channel - kRackPitchY, -5, 5).placed(rack_place) - taps, kBrass);
  const ProductId screw = model.product("rack screw M3x18", hex_screw(3, 18), kBlackOxide);
  for (const double z : {116.0, 150.0}) model.place(group, screw, facing_user(0, kCarriageFront - 4, z));
}

/// The thumb screw's thread, in the frame where its axis is z and its tip is at z = 0.
ThreadForm thumb_thread() {
  return trapezoidal_thread(8, 3);
}
constexpr double kThumbTip = 15.05, kThumbHeight = 136, kThumbPlay = 0.06;

void add_bracket(SampleModel& model) {
  const GroupId group = model.group("stage bracket");
  const double front = kCarriageFront + 8;
  const Solid body = block({-20, kCarriageFront, kCarriageLow}, {20, front, kPlatformTop}) +
                     std::vector<Solid>{block({-30, kCarriageFront, 148}, {30, 38, kPlatformTop}),
                                        block({-20, -20, 128}, {20, 20, 150})};
  const Placement thumb = facing_user(0, kThumbTip, kThumbHeight);
  const Solid tap = threaded_rod(with_play(thumb_thread(), 0.1, kThumbPlay), -3.5, 12, 0.5 + 0.4 - kThumbPlay, 0.3);
  std::vector<Solid> cuts{rod(30.05, 127, 157), tap.placed(thumb)};
  for (const double x : {-13.0, 13.0}) cuts.push_back(rod(4.4, -1, 9).placed(facing_user(x, kCarriageFront, 120)));
  for (const double x : {-22.0, 22.0}) cuts.push_back(rod(4.4, 147, 157).placed(at(x, 30, 0)));
  model.add(group, "stage bracket", body - cuts, kDarkGrey);
  const ProductId screw = model.product("bracket screw M4x16", hex_screw(4, 16), kSteel);
  for (const double x : {-13.0, 13.0}) model.place(group, screw, facing_user(x, front, 120));
  const Solid thumb_screw = threaded_rod(thumb_thread(), 0, 8, 0.4, 0.3) + prism(8, 15, 8, 14);
  model.add(group, "thumb screw threaded", thumb_screw, kBrass, thumb);
}

void add_stage(SampleModel& model) {
  const GroupId group = model.group("stage");
  std::vector<Solid> holes{rod(26, 150, 170)};
  for (const double x : {-22.0, 22.0}) holes.push_back(tapped_hole(4, 6).placed(upside_down(x, 30, kPlatformTop)));
  for (const double x : {-33.0, 33.0}) holes.push_back(rod(5, 158, 170).placed(at(x, 34, 0)));
  model.add(group, "stage plate", plate(130, 112, 4, kPlatformTop, kStageTop).placed(at(0, 6, 0)) - holes, kBlackOxide);
  const ProductId screw = model.product("stage screw M4x12", hex_screw(4, 12), kSteel);
  for (const double x : {-22.0, 22.0}) model.place(group, screw, upside_down(x, 30, 148));
  model.add(group, "specimen slide", block({-38, -13, kStageTop}, {38, 13, kStageTop + 1}), kGlass);
  const Solid clip =
      (block({-4, 8, kStageTop + 1}, {4, 40, kStageTop + 2.2}) + block({-4, 28, kStageTop}, {4, 40, kStageTop + 1.5})) +
      rod(5, 158.5, kStageTop + 1).placed(at(0, 34, 0));
  const ProductId clips = model.product("specimen clip", clip, kBrightSteel);
  for (const double x : {-33.0, 33.0}) model.place(group, clips, at(x, 0, 0));
}

void add_condenser(SampleModel& model) {
  const GroupId group = model.group("condenser");
  const Solid body = revolved({{0, 116}, {19, 116}, {19, 120}, {15, 120}, {15, 155}, {0, 155}});
  model.add(group, "condenser", body, kBlackOxide);
}

/// A thick disc below the nosepiece, its underside cut square to each objective.
Solid turret_body() {
  const Solid beyond_seat = block({-80, -80, -60}, {80, 80, 0});
  const Solid bore = rod(19, -1, 6);
  Solid body = rod(64, -56, -28);
  for (int i = 0; i < 3; ++i) body = body - beyond_seat.placed(objective_place(i));
  std::vector<Solid> cuts{rod(6.06, -60, 0)};
  for (int i = 0; i < 3; ++i) cuts.push_back(bore.placed(objective_place(i)));
  return body - cuts;
}

/// An objective hanging from its seat at z = 0; its cosmetic thread is much thicker than the turret's
/// drilled bore.
Solid objective(double length) {
  return revolved(
      {{0, 5}, {10.15, 5}, {10.15, 0}, {12, 0}, {12, -0.65 * length}, {5, -0.65 * length}, {5, -length}, {0, -length}});
}

void add_nosepiece(SampleModel& model) {
  const GroupId group = model.group("nosepiece");
  const Placement frame = turret_frame();
  const Solid wedge =
      (rod(58, -28, 40).placed(frame) & block({-60, -60, 150}, {60, 60, kLimbBottom})) + rod(30, 245, 262);
  const Solid pivot_hole = tapped_hole(5, 6.5).placed(frame * at(0, 0, -28) * turn_x(180));
  model.add(group, "nosepiece", wedge - pivot_hole, kDarkGrey);
  model.add(group, "nosepiece set screw M4x12", set_screw(4, 12), kSteel, facing_user(0, 27.1, 257));
  model.add(group, "turret", turret_body(), kBlackOxide, frame);
  const Solid pivot =
      (rod(10, 0, 4) + std::vector<Solid>{rod(6, -28, 0), rod(5, -34, -27)}) - block({-6, -0.8, 2.5}, {6, 0.8, 6});
  model.add(group, "turret pivot screw", pivot, kSteel, frame * at(0, 0, -56) * turn_x(180));
  const char* names[] = {"objective 40x", "objective 4x", "objective 10x"};
  const double lengths[] = {38, 22, 30};
  for (int i = 0; i < 3; ++i)
    model.add(group, names[i], objective(lengths[i]), i == 1 ? kBrass : kBrightSteel, frame * objective_place(i));
}

Placement tube_axis() {
  return at(0, -2, 312) * turn_x(-45);
}

void add_head(SampleModel& model) {
  const GroupId group = model.group("head");
  const Solid body =
      extruded({{-24, 286}, {24, 286}, {29.1, 317.7, 6}, {3.7, 343.1, 8}, {-24, 334, 14}}, -21, 21).placed(side_view());
  const Solid body_and_spigot = body + std::vector<Solid>{rod(30, 273, 287)};
  model.add(group, "head", body_and_spigot - std::vector<Solid>{rod(10, 260, 305), rod(28, 0, 40).placed(tube_axis())},
            kCream);
  model.add(group, "head set screw M4x12", set_screw(4, 12), kSteel, facing_user(0, 27.1, 279));
  const Solid tube_body = tube(28.03, 23.3, 17, 100);
  model.add(group, "tube", tube_body, kBlackOxide, tube_axis());
  const Solid eyepiece =
      revolved({{0, 60}, {11.6, 60}, {11.6, 100}, {18, 100}, {18, 114}, {8, 114}, {8, 111}, {0, 111}});
  model.add(group, "eyepiece", eyepiece, kDarkGrey, tube_axis());
  model.add(group, "eye lens", rod(16.03, 111, 114), kGlass, tube_axis());
}

}  // namespace

SampleModel make_microscope() {
  SampleModel model("microscope");
  add_stand(model);
  add_arm(model);
  add_lamp(model);
  add_focus_drive(model);
  add_carriage(model);
  add_bracket(model);
  add_stage(model);
  add_condenser(model);
  add_nosepiece(model);
  add_head(model);
  return model;
}

}  // namespace dismantle::samples
