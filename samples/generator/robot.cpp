// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/bearing.h"
#include "samples/generator/fastener.h"
#include "samples/generator/gear.h"
#include "samples/generator/samples.h"
#include "samples/generator/thread.h"

// A six-axis robot arm with a gripper, upper arm upright, forearm along +x. The base stands on z = 0.
namespace dismantle::samples {
namespace {

constexpr double kHousingTop = 100, kDeckLow = 101, kDeckHigh = 113;
constexpr double kShoulder = 180, kElbow = 400, kForearm = 454, kWrist = 196;
constexpr double kCheekIn = 30, kCheekOut = 44;  ///< Of the shoulder's fork, along y.
constexpr double kElbowIn = 20, kElbowOut = 32;  ///< Of the elbow's fork.
constexpr double kForkIn = 14, kForkOut = 22;    ///< Of the forearm's fork.
constexpr double kGripper = 226;                 ///< Where the gripper's body begins, along x.
const GearShape kSun{1, 18, 0.12}, kPlanet{1, 15, 0.12}, kRing{1, 48, 0.12};
const GearShape kWristGear{1, 30, 0.1}, kWristPinion{1, 22, 0.1};

/// The frame of a gear stage: the motor's face is at z = -6, the gears between 0 and 14, the drive points along +z.
Placement first_stage() {
  return at(0, 0, 62);
}
Placement second_stage() {
  return at(0, -68, kShoulder) * along_y();
}
Placement shoulder_axis() {
  return at(0, 0, kShoulder) * along_y();
}
Placement elbow_axis() {
  return at(0, 0, kElbow) * along_y();
}
Placement forearm_axis() {
  return at(0, 0, kForearm) * along_x();
}
Placement wrist_axis() {
  return at(kWrist, 0, kForearm) * along_y();
}

std::vector<Placement> motor_screws(double z) {
  return {at(-22, -22, z), at(22, 22, z)};
}

struct StageProducts {
  ProductId sun, planet, ring, carrier, motor, screw;
};

StageProducts make_stage(SampleModel& model) {
  StageProducts stage;
  const Solid body = block({-28, -28, -48}, {28, 28, -6}) + rod(8, -7, 15);
  stage.motor = model.product("motor 56", body - at_each(rod(4.4, -50, 0), motor_screws(0)), kDarkGrey);
  stage.screw = model.product("motor screw M4x46", hex_screw(4, 46), kSteel);
  stage.sun = model.product("sun gear", spur_gear(kSun, 0, 14) - rod(7.98, -1, 15), kSteel);
  stage.planet = model.product("planet gear", spur_gear(kPlanet, 0, 14) - rod(6.04, -1, 15), kBronze);
  stage.ring = model.product("ring gear", ring_gear(kRing, 64.03, 0, 14), kSteel);
  const double centres = pitch_diameter(kSun) + pitch_diameter(kPlanet);
  std::vector<Solid> parts = at_each(rod(6, 0, 16), around_z(3, centres));
  parts.push_back(block({-8, -8, 22}, {8, 8, 49}));
  stage.carrier = model.product("planet carrier", rod(46, 15, 23) + parts, kBrightSteel);
  return stage;
}

void place_stage(SampleModel& model, GroupId group, const StageProducts& stage, const Placement& frame) {
  model.place(group, stage.motor, frame);
  for (const Placement& screw : motor_screws(-48)) model.place(group, stage.screw, frame * screw * turn_x(180));
  model.place(group, stage.sun, frame);
  const double centres = pitch_diameter(kSun) + pitch_diameter(kPlanet);
  for (const Placement& planet : around_z(3, centres)) model.place(group, stage.planet, frame * planet);
  model.place(group, stage.ring, frame);
  model.place(group, stage.carrier, frame);
}

void add_base(SampleModel& model, const StageProducts& stage) {
  const GroupId group = model.group("base");
  std::vector<Solid> cuts;
  for (const Placement& place : around_z(3, 120, 0, 45)) cuts.push_back(rod(5.5, -1, 15).placed(place));
  for (const Placement& place : around_z(3, 120, 0, 45)) cuts.push_back(rod(10, -1, 5.2).placed(place));
  for (const Placement& place : motor_screws(0)) cuts.push_back(rod(9, -1, 15).placed(place));
  model.add(group, "base plate", plate(170, 170, 10, 0, 14) - cuts, kDarkGrey);
  std::vector<Solid> bores{rod(108, 13, 56), rod(64, 50, 87), rod(90, 86, kHousingTop + 1),
                           block({-20, -70, 24}, {20, -40, 44})};
  for (const Placement& place : around_z(3, 120, 14, 45))
    bores.push_back(tapped_hole(5, 12).placed(place * turn_x(180)));
  for (const Placement& place : motor_screws(56)) bores.push_back(tapped_hole(4, 5.5).placed(place * turn_x(180)));
  model.add(group, "base housing", rod(130, 14, kHousingTop) - bores, kOrange);
  const ProductId screw = model.product("base screw M5x18", cap_screw(5, 18), kSteel);
  for (const Placement& place : around_z(3, 120, 5.2, 45)) model.place(group, screw, place * turn_x(180));
  place_stage(model, group, stage, first_stage());
  model.add(group, "slewing bush", tube(90.03, 62.06, 86, kHousingTop), kBronze);
  model.add(group, "connector box", block({-19.9, -78, 24.1}, {19.9, -48, 43.9}), kBlackOxide);
}

void add_shoulder(SampleModel& model, const StageProducts& stage, const BearingProducts& bearing) {
  const GroupId group = model.group("shoulder");
  std::vector<Solid> parts{rod(62, 86, 102)};
  for (const double side : {-1.0, 1.0}) {
    const double y0 = side < 0 ? -kCheekOut : kCheekIn, y1 = side < 0 ? -kCheekIn : kCheekOut;
    parts.push_back(block({-42, y0, kDeckHigh - 2}, {42, y1, kShoulder}));
    parts.push_back(rod(84, y0, y1).placed(shoulder_axis()));
  }
  std::vector<Solid> cuts{block({-8.03, -8.03, 80}, {8.03, 8.03, kDeckHigh + 1}),
                          rod(26, -50, -20).placed(shoulder_axis()), rod(42, kCheekIn + 2, 60).placed(shoulder_axis()),
                          rod(26, 20, 60).placed(shoulder_axis())};
  for (const Placement& place : around_z(2, 72, -kCheekOut))
    cuts.push_back(tapped_hole(4, 12).placed(shoulder_axis() * place * turn_x(180)));
  for (const Placement& place : around_z(2, 56, kCheekOut, 90))
    cuts.push_back(tapped_hole(3, 8).placed(shoulder_axis() * place));
  model.add(group, "turntable", (rod(128, kDeckLow, kDeckHigh) + parts) - cuts, kOrange);

  const Placement frame = second_stage();
  const Solid shell = rod(84, -6, 24) - std::vector<Solid>{rod(64, 0, 25), rod(20, -7, 1)};
  std::vector<Solid> holes = at_each(rod(4.4, -7, 25), around_z(2, 72));
  for (const Placement& place : motor_screws(-6)) holes.push_back(tapped_hole(4, 5.5).placed(place * turn_x(180)));
  model.add(group, "gearbox housing", shell - holes, kOrange, frame);
  const ProductId long_screw = model.product("gearbox screw M4x40", hex_screw(4, 40), kSteel);
  for (const Placement& place : around_z(2, 72, -6)) model.place(group, long_screw, frame * place * turn_x(180));
  place_stage(model, group, stage, frame);
  place_bearing(model, group, bearing, shoulder_axis() * at(0, 0, kCheekIn + 2));
  model.add(group, "shoulder trunnion", rod(19.96, 14, kCheekOut), kBrightSteel, shoulder_axis());
  const Solid cap = rod(64, kCheekOut, kCheekOut + 5) - at_each(rod(3.4, 40, 60), around_z(2, 56, 0, 90));
  model.add(group, "shoulder cap", cap, kDarkGrey, shoulder_axis());
  const ProductId screw = model.product("cap screw M3x10", hex_screw(3, 10), kSteel);
  for (const Placement& place : around_z(2, 56, kCheekOut + 5, 90)) model.place(group, screw, shoulder_axis() * place);
}

void add_upper_arm(SampleModel& model) {
  const GroupId group = model.group("upper arm");
  const Solid body =
      rod(64, -28, 28).placed(shoulder_axis()) + std::vector<Solid>{block({-24, -28, kShoulder}, {24, 28, 350}),
                                                                    block({-24, -18, 340}, {24, 18, kElbow}),
                                                                    rod(56, -18, 18).placed(elbow_axis())};
  const Solid pocket = block({-14, 10, 225}, {14, 40, 335});
  const std::vector<Solid> cuts{pocket,
                                pocket.placed(turn_z(180)),
                                block({-8.03, -40, -8.03}, {8.03, -16, 8.03}).placed(at(0, 0, kShoulder)),
                                rod(20, 10, 40).placed(shoulder_axis()),
                                rod(12.04, -30, -4).placed(elbow_axis()),
                                rod(16, 2, 30).placed(elbow_axis())};
  model.add(group, "upper arm", body - cuts, kOrange);
}

void add_elbow(SampleModel& model) {
  const GroupId group = model.group("elbow");
  std::vector<Solid> parts;
  for (const double side : {-1.0, 1.0}) {
    const double y0 = side < 0 ? -kElbowOut : kElbowIn, y1 = side < 0 ? -kElbowIn : kElbowOut;
    parts.push_back(block({-26, y0, kElbow}, {26, y1, 432}));
    parts.push_back(rod(52, y0, y1).placed(elbow_axis()));
  }
  std::vector<Solid> cuts{rod(22, -40, 0).placed(elbow_axis()), rod(20, 0, 40).placed(elbow_axis()),
                          rod(32, 26, 60).placed(forearm_axis()), rod(26, -50, 40).placed(forearm_axis())};
  const std::vector<Placement> small_screws{at(-16, -16, 0), at(16, 16, 0)};
  for (const Placement& place : small_screws)
    cuts.push_back(tapped_hole(3, 10).placed(elbow_axis() * place * at(0, 0, -kElbowOut) * turn_x(180)));
  for (const Placement& place : small_screws)
    cuts.push_back(tapped_hole(3, 10).placed(forearm_axis() * place * at(0, 0, -34) * turn_x(180)));
  model.add(group, "elbow", (block({-34, -32, 430}, {46, 32, 478}) + parts) - cuts, kOrange);

  const Solid motor = (block({-21, -21, -40}, {21, 21, 0}) + rod(12, -1, 27)) - at_each(rod(3.4, -50, 1), small_screws);
  const ProductId motors = model.product("motor 42", motor, kDarkGrey);
  const ProductId screw = model.product("motor screw M3x48", hex_screw(3, 48), kSteel);
  for (const Placement& frame : {elbow_axis() * at(0, 0, -kElbowOut), forearm_axis() * at(0, 0, -34)}) {
    model.place(group, motors, frame);
    for (const Placement& place : small_screws) model.place(group, screw, frame * place * at(0, 0, -40) * turn_x(180));
  }
  model.add(group, "elbow bush", tube(20.03, 16.06, kElbowIn, kElbowOut), kBronze, elbow_axis());
  model.add(group, "elbow trunnion", rod(16.02, 4, kElbowIn) + rod(15.98, 19, 36) - tube(18, 14, 32.2, 33.4),
            kBrightSteel, elbow_axis());
  model.add(group, "circlip 14", circlip(13, 2, 1), kBlackOxide, elbow_axis() * at(0, 0, 32.3));
  model.add(group, "forearm bush", tube(32.03, 20.06, 26, 46), kBronze, forearm_axis());
}

void add_forearm(SampleModel& model) {
  const GroupId group = model.group("forearm");
  const Solid tube_body = rod(19.96, 8, 50) + std::vector<Solid>{rod(44, 48, 150)};
  Solid body = tube_body.placed(forearm_axis());
  for (const double side : {-1.0, 1.0}) {
    const double y0 = side < 0 ? -kForkOut : kForkIn, y1 = side < 0 ? -kForkIn : kForkOut;
    body = body + std::vector<Solid>{block({140, y0, kForearm - 16}, {kWrist, y1, kForearm + 16}),
                                     rod(32, y0, y1).placed(wrist_axis())};
  }
  const Placement pinion = at(kWrist - 26.05, 0, kForearm) * along_y();
  std::vector<Solid> cuts{rod(12.04, 0, 30).placed(forearm_axis()), rod(10.04, -40, 40).placed(wrist_axis()),
                          block({149.5, -kForkIn, 420}, {176, kForkIn, 490}), rod(5.04, 10, 40).placed(pinion)};
  model.add(group, "forearm", body - cuts, kOrange);
  model.add(group, "wrist motor", block({-9, -11, -12}, {9, 11, kForkIn}) + rod(5, kForkIn - 1, 32), kDarkGrey,
            pinion * turn_z(0));
  model.add(group, "wrist pinion", spur_gear(kWristPinion, 24, 30) - rod(4.98, 20, 40), kSteel,
            pinion * turn_z(180.0 / 22));
}

void add_wrist(SampleModel& model) {
  const GroupId group = model.group("wrist");
  const Solid body =
      rod(32, -13.97, 13.97).placed(wrist_axis()) + block({kWrist, -13.97, kForearm - 14}, {218, 13.97, kForearm + 14});
  const Placement axis = forearm_axis();
  model.add(group, "wrist block",
            body - std::vector<Solid>{rod(10, -30, 30).placed(wrist_axis()), rod(14.04, kWrist + 8, 230).placed(axis)},
            kAluminium);
  const Solid pin =
      rod(10.02, -13.5, 13.5) + std::vector<Solid>{rod(10, -25, -13), rod(10, 13, 32)} - tube(12, 9, -23.3, -22.2);
  model.add(group, "wrist pin", pin, kBrightSteel, wrist_axis());
  model.add(group, "circlip 9", circlip(8.2, 1.6, 1), kBlackOxide, wrist_axis() * at(0, 0, -23.25));
  model.add(group, "wrist gear", spur_gear(kWristGear, 24, 30) - rod(9.98, 20, 40), kBronze, wrist_axis());
  const Solid flange = rod(14, kWrist + 8.5, 220) + rod(40, 219, kGripper);
  model.add(group, "tool flange",
            flange - std::vector<Solid>{tapped_hole(4, 6).placed(at(-14, 0, kGripper)),
                                        tapped_hole(4, 6).placed(at(14, 0, kGripper))},
            kBrightSteel, axis);
}

/// The gripper's frame: z along the robot's +x, x down, y across the jaws.
Placement gripper_frame() {
  return at(kGripper, 0, kForearm) * along_x();
}
ThreadForm screw_thread() {
  return trapezoidal_thread(10, 4);
}

void add_gripper(SampleModel& model) {
  const GroupId group = model.group("gripper");
  const Placement frame = gripper_frame();
  const Placement screw_axis = at(0, 0, 20) * along_y();
  // A T-slot across the front: 30 wide at the bottom, 16 at the mouth.
  std::vector<Solid> cuts{block({-15, -60, 11}, {15, 60, 29}),    block({-9, -60, 28}, {9, 60, 40}),
                          rod(4.4, -1, 12).placed(at(-14, 0, 0)), rod(4.4, -1, 12).placed(at(14, 0, 0)),
                          rod(9, 3, 12).placed(at(-14, 0, 4)),    rod(9, 3, 12).placed(at(14, 0, 4))};
  model.add(group, "gripper body", block({-22, -45, 0}, {22, 45, 35}) - cuts, kDarkGrey, frame);
  const ProductId screw = model.product("gripper screw M4x10", hex_screw(4, 10), kSteel);
  for (const double x : {-14.0, 14.0}) model.place(group, screw, frame * at(x, 0, 7));

  auto finger = [](double y0, double y1, double tip0, double tip1) {
    return block({-14.97, y0, 11.03}, {14.97, y1, 28.97}) +
           std::vector<Solid>{block({-8.97, y0, 28}, {8.97, y1, 48}), block({-8.97, tip0, 46}, {8.97, tip1, 90})};
  };
  const double play = 0.1;
  const Solid tap = threaded_rod(with_play(screw_thread(), 0.15, play), 4, 36, 1 + 2 - play, 0.3).placed(screw_axis);
  model.add(group, "moving finger", finger(8, 24, 8, 14) - tap, kAluminium, frame);
  model.add(group, "fixed finger", finger(-24, -8, -14, -8) - rod(5.7, -30, 0).placed(screw_axis), kAluminium, frame);
  const Solid lead =
      threaded_rod(screw_thread(), 5, 31, 2, 0.5) + std::vector<Solid>{rod(6.5, 30, 56), rod(5.6, -30, 6)};
  model.add(group, "lead screw threaded", lead, kBrightSteel, frame * screw_axis);
  model.add(group, "hand knob", ridged_knob({22, 10, 10, 6.48}), kBlackOxide, frame * screw_axis * at(0, 0, 46));
}

}  // namespace

SampleModel make_robot() {
  SampleModel model("robot");
  const StageProducts stage = make_stage(model);
  const BearingProducts bearing = make_roller_bearing(model, "bearing 20x42", {});
  add_base(model, stage);
  add_shoulder(model, stage, bearing);
  add_upper_arm(model);
  add_elbow(model);
  add_forearm(model);
  add_wrist(model);
  add_gripper(model);
  return model;
}

}  // namespace dismantle::samples
