// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/fastener.h"
#include "samples/generator/lathe_parts.h"

namespace dismantle::samples::lathe {
namespace {

constexpr double kSaddleTop = 188, kSlideTop = 225, kTurretSeat = 252, kTurretTop = 308;
constexpr double kSlideX = 130, kTurretY = -105;  ///< The cross slide's screw; the turret's pivot stands on it.
constexpr double kSaddleFront = -100, kApronFront = -125;
constexpr double kCrossScrewZ = 197, kWayPlay = 0.03;

/// The cross slide's dovetail, grown by `play`, between two places along y.
Solid cross_dovetail(double play, double y0, double y1) {
  const double low = 22 + play, high = 30 + play, top = kSaddleTop + 14 + play;
  return extruded({{kSlideX - low, kSaddleTop - 1},
                   {kSlideX + low, kSaddleTop - 1},
                   {kSlideX + low, kSaddleTop},
                   {kSlideX + high, top},
                   {kSlideX - high, top},
                   {kSlideX - low, kSaddleTop}},
                  -y1, -y0)
      .placed(front_view());
}

Placement cross_axis(double y) {
  return at(kSlideX, y, kCrossScrewZ) * along_y();
}
Placement turret_place(double z) {
  return at(kSlideX, kTurretY, z);
}

void add_saddle(SampleModel& model, GroupId group) {
  const Solid body =
      block({kSaddleLow, kSaddleFront, kWays}, {kSaddleHigh, 75, kSaddleTop}) + cross_dovetail(0, kSaddleFront, 75);
  std::vector<Solid> cuts{vee(kSaddleLow - 1, kSaddleHigh + 1),
                          block({kSlideX - 12, kSaddleFront - 1, 191}, {kSlideX + 12, 76, 210}),
                          rod(3.98, 178, 192).placed(at(kSlideX + 8.5, -20, 0))};
  for (const double x : {80.0, 180.0}) cuts.push_back(tapped_hole(8, 18).placed(at(x, kSaddleFront, 174) * turn_x(90)));
  model.add(group, "saddle", body - cuts, kMachineGreen);
  const Solid apron = extruded({{kApronFront, 95},
                                {-85, 95},
                                {-85, kWays},
                                {kSaddleFront, kWays},
                                {kSaddleFront, kSaddleTop},
                                {kApronFront, kSaddleTop}},
                               kSaddleLow, kSaddleHigh)
                          .placed(side_view());
  std::vector<Solid> holes{rod(33.97, kSaddleLow - 1, kSaddleHigh + 1).placed(lead_axis(0)),
                           rod(16.04, -1, 25).placed(at(78, kApronFront, 154) * along_y())};
  for (const double x : {80.0, 180.0}) holes.push_back(rod(8.8, -1, 30).placed(at(x, kApronFront, 174) * along_y()));
  model.add(group, "apron", apron - holes, kMachineGreen);
  const ProductId screw = model.product("apron screw M8x40", cap_screw(8, 40), kBlackOxide);
  for (const double x : {80.0, 180.0}) model.place(group, screw, at(x, kApronFront, 174) * turn_x(90));
  const double play = 0.08, first = -100 - play + 18 * lead_thread().pitch;
  const Solid tap = threaded_rod(with_play(lead_thread(), 0.12, play), 75, 170, first - 75, 0.3);
  model.add(group, "lead nut threaded", rod(34, 105, 155) - tap, kBronze, lead_axis(0));
  const Solid shaft = rod(16, -30, 23);
  model.add(group, "carriage shaft", shaft, kBrightSteel, at(78, kApronFront, 154) * along_y());
  model.add(group, "carriage handwheel", handwheel({64, 10, 15.97}), kBlackOxide,
            at(78, kApronFront - 28, 154) * along_y());
}

void add_cross_slide(SampleModel& model, GroupId group) {
  std::vector<Solid> cuts{cross_dovetail(kWayPlay, -143, -10),
                          block({kSlideX - 12, -143, kSaddleTop}, {kSlideX + 12, -10, 206}),
                          rod(12.06, -20, 20).placed(cross_axis(-150))};
  for (const double x : {-33.0, 33.0}) cuts.push_back(tapped_hole(6, 12).placed(turret_place(kSlideTop) * at(x, 0, 0)));
  const Solid body = block({88, -155, kSaddleTop + kWayPlay}, {172, -20, kSlideTop});
  model.add(group, "cross slide", body - cuts, kMachineGreen);
  model.add(group, "cross nut",
            block({kSlideX - 11.95, -50, 191}, {kSlideX + 11.95, -12, 205.5}) -
                std::vector<Solid>{rod(12 - kThreadOverlap, -20, 60).placed(cross_axis(-40)),
                                   rod(4.03, 180, 193).placed(at(kSlideX + 8.5, -20, 0))},
            kBronze);
  model.add(group, "cross nut dowel", dowel_pin(4, 15), kBrightSteel, at(kSlideX + 8.5, -20, 178));
  model.add(group, "cross screw", rod(12, -200, -8), kBrightSteel, cross_axis(0));
  model.add(group, "cross handwheel", handwheel({64, 10, 11.97}), kBlackOxide, cross_axis(-196));
}

void add_turret(SampleModel& model, GroupId group) {
  std::vector<Solid> base_cuts{tapped_hole(20, 20).placed(turret_place(kTurretSeat))};
  for (const double x : {-33.0, 33.0})
    base_cuts.push_back(cap_screw_counterbore(6, 30).placed(turret_place(kTurretSeat) * at(x, 0, 0)));
  model.add(group, "turret base", block({86, kTurretY - 42, kSlideTop}, {174, kTurretY + 42, kTurretSeat}) - base_cuts,
            kSteel);
  const ProductId base_screw = model.product("turret base screw M6x30", cap_screw(6, 30), kBlackOxide);
  for (const double x : {-33.0, 33.0}) model.place(group, base_screw, turret_place(kTurretSeat - 6.4) * at(x, 0, 0));

  std::vector<Placement> stations;
  for (const Placement& station : around_z(6, 0, kAxis - kTurretSeat, 30)) stations.push_back(station);
  std::vector<Solid> cuts{rod(20.06, -1, 60)};
  for (const Placement& station : stations) {
    cuts.push_back(rod(20.04, 15, 60).placed(station * along_x()));
    cuts.push_back(tapped_hole(8, 20).placed(station * at(28, 0, kTurretTop - kAxis)));
  }
  model.add(group, "turret", prism(6, 80, 0, kTurretTop - kTurretSeat) - cuts, kToolSteel, turret_place(kTurretSeat));
  const Solid lever = block({-6, -80, 4}, {6, 0, 14});
  const Solid pivot = rod(20, -75, 1) + std::vector<Solid>{rod(36, 0, 16), lever};
  model.add(group, "turret clamp lever", pivot, kBlackOxide, turret_place(kTurretTop));
  const Solid drill = rod(20, 16, 60) + rod(10, 59, 100);
  const Solid boring = rod(20, 16, 58) + std::vector<Solid>{rod(14, 57, 95), block({-2, 0, 90}, {2, 9, 94})};
  const Solid turning = rod(20, 16, 64).placed(along_x()) + block({50, -5, -5}, {82, 5, 5});
  const ProductId tools[] = {model.product("turning tool", turning, kBrightSteel),
                             model.product("drill", drill.placed(along_x()), kBrightSteel),
                             model.product("boring bar", boring.placed(along_x()), kBrightSteel)};
  const ProductId set = model.product("tool screw M8x18", set_screw(8, 17.9), kBlackOxide);
  for (int i = 1; i < 6; i += 2) {
    model.place(group, tools[i / 2], turret_place(kTurretSeat) * stations[static_cast<std::size_t>(i)]);
    model.place(group, set,
                turret_place(kTurretSeat) * stations[static_cast<std::size_t>(i)] * at(28, 0, kTurretTop - kAxis));
  }
}

}  // namespace

void add_carriage(SampleModel& model) {
  const GroupId group = model.group("carriage");
  add_saddle(model, group);
  add_cross_slide(model, group);
  add_turret(model, group);
}

void add_tailstock(SampleModel& model) {
  const GroupId group = model.group("tailstock");
  const Solid body =
      block({300, -62, kWays}, {400, 62, 200}) +
      std::vector<Solid>{block({300, -28, 190}, {400, 28, kAxis}), rod(80, 300, 400).placed(spindle_axis(0))};
  std::vector<Solid> cuts{vee(299, 401), rod(40.05, 290, 410).placed(spindle_axis(0)),
                          tapped_hole(10, 25).placed(at(330, 0, kAxis + 41))};
  for (const Placement& place : around_z(2, 60, 400))
    cuts.push_back(tapped_hole(5, 14).placed(spindle_axis(0) * place));
  model.add(group, "tailstock", body - cuts, kMachineGreen);
  const Solid quill = rod(40, 262, 392) - std::vector<Solid>{rod(16, 261, 302), rod(14 - kThreadOverlap, 330, 393)};
  model.add(group, "quill", quill, kBrightSteel, spindle_axis(0));
  const Solid centre = revolved({{0.2, 230.1}, {8, 244}, {8.015, 264}, {8.015, 300}, {0, 300}, {0, 230.1}});
  model.add(group, "centre", centre, kToolSteel, spindle_axis(0));
  std::vector<Solid> holes{rod(14.06, 390, 410)};
  for (const Placement& place : around_z(2, 60, 400)) holes.push_back(rod(5.5, -1, 10).placed(place));
  model.add(group, "tailstock cap", rod(80, 400, 408) - holes, kSteel, spindle_axis(0));
  const ProductId screw = model.product("cap screw M5x18", cap_screw(5, 18), kBlackOxide);
  for (const Placement& place : around_z(2, 60, 408)) model.place(group, screw, spindle_axis(0) * place);
  model.add(group, "tail screw", rod(14, 332, 445), kBrightSteel, spindle_axis(0));
  model.add(group, "tail handwheel", handwheel({96, 12, 13.97}), kBlackOxide, spindle_axis(424));
  const Solid lock = rod(10, -20.9, 16) + std::vector<Solid>{rod(18, 15, 27), block({-4, -50, 18}, {4, 0, 25})};
  model.add(group, "quill lock", lock, kSteel, at(330, 0, kAxis + 41));
}

}  // namespace dismantle::samples::lathe
