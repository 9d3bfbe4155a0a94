// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/fastener.h"
#include "samples/generator/samples.h"
#include "samples/generator/thread.h"

// A two-plate injection mould for a round cup. It opens along z; the parting plane is z = 137.
namespace dismantle::samples {
namespace {

constexpr double kHalfWidth = 100, kClampHalfWidth = 120;
constexpr double kRailLow = 20, kSupportLow = 76, kCoreLow = 101, kParting = 137, kCavityHigh = 173, kTop = 193;
constexpr double kEjectorLow = 24, kEjectorSplit = 40, kEjectorHigh = 52;
constexpr double kInsertDepth = 24;  ///< Of the pockets for the inserts, from the parting plane.
constexpr double kCoreHeight = 15, kWall = 2, kCoreDiameter = 46;
constexpr double kChannelY = 58;  ///< Of the cooling channels.
constexpr double kChannelHeight = 155;

std::vector<Placement> pillars(double z) {
  return at_corners(152, 152, z);
}
std::vector<Placement> frame_screws(double z) {
  return at_corners(168, 96, z);
}
std::vector<Placement> insert_screws(double z) {
  return {at(-31, -31, z), at(31, 31, z)};
}
std::vector<Placement> ejector_pins(double z) {
  return around_z(3, 28, z, 45);
}
std::vector<Placement> return_pins(double z) {
  return {at(-42, -75, z), at(42, 75, z)};
}
std::vector<Placement> ejector_screws(double z) {
  return {at(-50, 60, z), at(50, -60, z)};
}
std::vector<Placement> dowels(double z) {
  return {at(-84, 0, z), at(84, 0, z)};
}
std::vector<Placement> upward(std::vector<Placement> places) {
  for (Placement& place : places) place = place * turn_x(180);
  return places;
}

Solid slab(double half_x, double half_y, double z0, double z1) {
  return block({-half_x, -half_y, z0}, {half_x, half_y, z1});
}

void append(std::vector<Solid>& cuts, const std::vector<Solid>& more) {
  cuts.insert(cuts.end(), more.begin(), more.end());
}

/// The two cooling channels through a plate, along x, with a tapped mouth at each end.
std::vector<Solid> channels(double z) {
  std::vector<Solid> cuts;
  for (const double y : {-kChannelY, kChannelY})
    cuts.push_back(rod(8.4, -kHalfWidth - 1, kHalfWidth + 1).placed(at(0, y, z) * along_x()));
  return cuts;
}

void add_frame(SampleModel& model) {
  const GroupId group = model.group("ejector side");
  std::vector<Solid> bottom_cuts{rod(32, -1, kRailLow + 1)};
  append(bottom_cuts, at_each(cap_screw_counterbore(10, 21), upward(frame_screws(0))));
  model.add(group, "bottom clamp plate", slab(kClampHalfWidth, kHalfWidth, 0, kRailLow) - bottom_cuts, kSteel);
  for (const double side : {-1.0, 1.0}) {
    const Solid bar =
        slab(16, kHalfWidth, kRailLow, kSupportLow) - at_each(rod(11, 0, 100), {at(0, -48, 0), at(0, 48, 0)});
    model.add(group, side < 0 ? "left rail" : "right rail", bar, kToolSteel, at(84 * side, 0, 0));
  }
  std::vector<Solid> support_cuts = at_each(rod(11, kSupportLow - 1, kCoreLow + 1), frame_screws(0));
  append(support_cuts, at_each(rod(7, kSupportLow - 1, kCoreLow + 1), ejector_pins(0)));
  append(support_cuts, at_each(rod(12.06, kSupportLow - 1, kCoreLow + 1), return_pins(0)));
  append(support_cuts, at_each(rod(7.98, kCoreLow - 14, kCoreLow + 1), dowels(0)));
  model.add(group, "support plate", slab(kHalfWidth, kHalfWidth, kSupportLow, kCoreLow) - support_cuts, kSteel);
  const ProductId screw = model.product("frame screw M10x110", cap_screw(10, 110), kBlackOxide);
  model.place_all(group, screw, upward(frame_screws(10.4)));
  const ProductId dowel = model.product("dowel 8x26", dowel_pin(8, 26), kBrightSteel);
  model.place_all(group, dowel, dowels(kCoreLow - 14));
}

void add_ejector(SampleModel& model) {
  const GroupId group = model.group("ejector");
  const ProductId pad = model.product("rest pad", slab(9, 9, kRailLow, kEjectorLow), kSteel);
  model.place_all(group, pad, at_corners(110, 170));
  const std::vector<Placement> screws = ejector_screws(kEjectorLow);
  std::vector<Solid> base_cuts = at_each(cap_screw_counterbore(6, 17), upward(screws));
  base_cuts.push_back(rod(14, kEjectorLow - 1, kEjectorSplit + 1));
  base_cuts.push_back(rod(18, kEjectorLow - 1, kEjectorLow + 1.5));
  model.add(group, "ejector base plate", slab(66, kHalfWidth, kEjectorLow, kEjectorSplit) - base_cuts, kSteel);
  std::vector<Solid> cuts = at_each(tapped_hole(6, 11).placed(turn_x(180)), ejector_screws(kEjectorSplit));
  append(cuts, at_each(rod(12.4, -1, 4) + rod(6.6, 3, 20), ejector_pins(kEjectorSplit)));
  append(cuts, at_each(rod(18.4, -1, 5) + rod(12.4, 4, 20), return_pins(kEjectorSplit)));
  model.add(group, "ejector retainer plate", slab(66, kHalfWidth, kEjectorSplit, kEjectorHigh) - cuts, kSteel);
  const ProductId screw = model.product("ejector screw M6x18", cap_screw(6, 18), kBlackOxide);
  model.place_all(group, screw, upward(ejector_screws(kEjectorLow + 6.4)));
  const double pin_length = kParting + kCoreHeight - kEjectorSplit;
  const ProductId pin = model.product("ejector pin 6", rod(12, 0, 4) + rod(6, 3, pin_length), kBrightSteel);
  model.place_all(group, pin, ejector_pins(kEjectorSplit));
  const ProductId back =
      model.product("return pin 12", rod(18, 0, 5) + rod(12, 4, kParting - kEjectorSplit), kBrightSteel);
  model.place_all(group, back, return_pins(kEjectorSplit));
  const ProductId spring = model.product("urethane spring", tube(24, 13, 0, kSupportLow - kEjectorHigh), kOrange);
  model.place_all(group, spring, return_pins(kEjectorHigh));
  model.add(group, "ejector rod", rod(28, -40, kEjectorLow) + rod(16, kEjectorLow - 1, kEjectorSplit - 2), kToolSteel);
}

void add_core_side(SampleModel& model) {
  const GroupId group = model.group("core side");
  const double seat = kParting - kInsertDepth;
  std::vector<Solid> cuts{plate(80, 80, 4, seat, kParting + 1)};
  append(cuts, at_each(rod(30, kCoreLow - 1, kParting + 1), pillars(0)));
  append(cuts, at_each(tapped_hole(10, 20).placed(turn_x(180)), frame_screws(kCoreLow)));
  append(cuts, at_each(rod(7, kCoreLow - 1, seat + 1), ejector_pins(0)));
  append(cuts, at_each(rod(12.06, kCoreLow - 1, kParting + 1), return_pins(0)));
  append(cuts, at_each(rod(8.04, kCoreLow - 1, kCoreLow + 13), dowels(0)));
  append(cuts, at_each(cap_screw_counterbore(6, 13), upward(insert_screws(kCoreLow))));
  model.add(group, "core plate", slab(kHalfWidth, kHalfWidth, kCoreLow, kParting) - cuts, kAluminium);

  const Solid core = plate(80, 80, 4, seat, kParting) + rod(kCoreDiameter, kParting - 1, kParting + kCoreHeight);
  std::vector<Solid> core_cuts = at_each(rod(6.04, seat - 1, kParting + 20), ejector_pins(0));
  append(core_cuts, at_each(tapped_hole(6, 12).placed(turn_x(180)), insert_screws(seat)));
  model.add(group, "core insert", core - core_cuts, kToolSteel);
  const ProductId screw = model.product("insert screw M6x14", cap_screw(6, 14), kBlackOxide);
  model.place_all(group, screw, upward(insert_screws(kCoreLow + 6.4)));
  const Solid bush = tube(30.03, 20.06, kCoreLow, kParting);
  const ProductId bushes = model.product("guide bush 20", bush, kBronze);
  model.place_all(group, bushes, pillars(0));
}

constexpr double kSprueDiameter = 5;

void add_cavity_side(SampleModel& model) {
  const GroupId group = model.group("cavity side");
  const double seat = kParting + kInsertDepth, gate = kParting + kCoreHeight + kWall;
  std::vector<Solid> cuts{plate(80, 80, 4, kParting - 1, seat), rod(18.06, seat - 1, kCavityHigh + 1)};
  append(cuts, at_each(rod(26, kParting - 1, kCavityHigh + 1), pillars(0)));
  append(cuts, at_each(tapped_hole(10, 25), frame_screws(kCavityHigh)));
  append(cuts, at_each(cap_screw_counterbore(6, 13), insert_screws(kCavityHigh)));
  append(cuts, channels(kChannelHeight));
  const ThreadForm form = metric_thread(12, 1.75);
  const Placement eye = at(0, kHalfWidth, 165) * along_y();
  cuts.push_back(threaded_rod(with_play(form, 0.1, 0.05), -7.5, 4, 0.5 + 0.3 * 1.75 - 0.05, 0.2).placed(eye));
  model.add(group, "cavity plate", slab(kHalfWidth, kHalfWidth, kParting, kCavityHigh) - cuts, kAluminium);
  const Solid ring = (tube(40, 22, -5, 5).placed(along_x()) & slab(5, 40, -40, 40)).placed(at(0, 0, 24));
  const Solid shaft = threaded_rod(form, -7, 0, 0.3 * 1.75, 0.3);
  model.add(group, "eye bolt M12 threaded", shaft + std::vector<Solid>{rod(22, 0, 5), ring}, kSteel, eye);

  std::vector<Solid> cavity_cuts{rod(kCoreDiameter + 2 * kWall, kParting - 1, gate), rod(18.06, gate - 1, seat + 1)};
  append(cavity_cuts, at_each(tapped_hole(6, 10), insert_screws(seat)));
  model.add(group, "cavity insert", plate(80, 80, 4, kParting, seat) - cavity_cuts, kToolSteel);
  const ProductId screw = model.product("insert screw M6x14 top", cap_screw(6, 14), kBlackOxide);
  model.place_all(group, screw, insert_screws(kCavityHigh - 6.4));
  const Solid pillar = rod(26.03, kParting, kCavityHigh) + rod(20, kCoreLow + 2, kParting + 1);
  const ProductId leader = model.product("guide pillar 20", pillar, kBrightSteel);
  model.place_all(group, leader, pillars(0));

  std::vector<Solid> top_cuts{rod(38.1, 181, kTop + 1), rod(18.06, 170, 182)};
  append(top_cuts, at_each(cap_screw_counterbore(10, 21), frame_screws(kTop)));
  append(top_cuts, at_each(tapped_hole(6, 12), around_z(2, 70, kTop, 90)));
  model.add(group, "top clamp plate", slab(kClampHalfWidth, kHalfWidth, kCavityHigh, kTop) - top_cuts, kSteel);
  const ProductId clamp_screw = model.product("clamp screw M10x30", cap_screw(10, 30), kBlackOxide);
  model.place_all(group, clamp_screw, frame_screws(kTop - 10.4));
  const Solid bush = (rod(18, gate, 182) + rod(38, 181, kTop)) - rod(kSprueDiameter, gate - 1, kTop);
  model.add(group, "sprue bush", bush, kToolSteel);
  const Solid locating =
      tube(90, 30, kTop, kTop + 12) - at_each(cap_screw_counterbore(6, 13), around_z(2, 70, kTop + 12, 90));
  model.add(group, "locating ring", locating, kBlackOxide);
  const ProductId ring_screw = model.product("ring screw M6x16", cap_screw(6, 16), kSteel);
  model.place_all(group, ring_screw, around_z(2, 70, kTop + 12 - 6.4, 90));
}

void add_moulding_and_cooling(SampleModel& model) {
  const double roof = kParting + kCoreHeight, gate = roof + kWall;
  const Solid cup = rod(kCoreDiameter + 2 * kWall, kParting, gate) - rod(kCoreDiameter, kParting - 1, roof);
  const Solid stalk = rod(kSprueDiameter, gate - 0.5, 185);
  model.add(model.group("moulding"), "moulded cup", cup + stalk, kOrange);

  const GroupId group = model.group("cooling");
  const Solid nipple = (rod(9.4, -12, 1) + std::vector<Solid>{prism(6, 14, 0, 6), rod(9, 5, 20)}) - rod(5, -13, 23);
  const ProductId nipples = model.product("hose nipple", nipple, kBrass);
  const ProductId plugs = model.product("channel plug", set_screw(8.64, 10), kBrass);
  for (const double y : {-kChannelY, kChannelY}) {
    model.place(group, nipples, at(kHalfWidth, y, kChannelHeight) * along_x());
    model.place(group, plugs, at(-kHalfWidth, y, kChannelHeight) * turn_y(-90));
  }
}

}  // namespace

SampleModel make_tooling() {
  SampleModel model("tooling");
  add_frame(model);
  add_ejector(model);
  add_core_side(model);
  add_cavity_side(model);
  add_moulding_and_cooling(model);
  return model;
}

}  // namespace dismantle::samples
