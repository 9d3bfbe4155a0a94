// SPDX-License-Identifier: Apache-2.0
#include "samples/generator/bearing.h"

#include <cmath>

namespace dismantle::samples {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRunningClearance = 0.03;  ///< Between a rolling body and its races [mm].
constexpr double kCageClearance = 0.3;      ///< Between the cage and the rings [mm].
constexpr double kShoulderClearance = 0.1;  ///< Between the balls and the side of the outer ring that has no shoulder.
constexpr double kPocketClearance = 0.2;    ///< Added to the rolling body's diameter for the cage's pocket [mm].

}  // namespace

BearingProducts make_ball_bearing(SampleModel& model, const std::string& name, const BallBearing& bearing) {
  const double pitch = (bearing.outer_diameter + bearing.bore) / 2, width = bearing.width;
  const double ball_diameter = 0.3 * (bearing.outer_diameter - bearing.bore);
  const double inner_shoulder = pitch - 0.5 * ball_diameter, outer_shoulder = pitch + 0.5 * ball_diameter;
  const Solid groove = torus(pitch, ball_diameter + 2 * kRunningClearance).placed(at(0, 0, width / 2));

  const Solid inner = tube(inner_shoulder, bearing.bore, 0, width) - groove;
  const Solid open_side = rod(pitch + ball_diameter + 2 * kShoulderClearance, -1, width / 2);
  // In two steps: the groove alone would meet the bore's cylinder along the torus' seam.
  const Solid outer = (tube(bearing.outer_diameter, outer_shoulder, 0, width) - open_side) - groove;

  const double half_cage = ball_diameter / 2 + 0.15 * ball_diameter;
  const Solid band = tube(outer_shoulder - 2 * kCageClearance, inner_shoulder + 2 * kCageClearance,
                          width / 2 - half_cage, width / 2 + half_cage);
  const Solid pocket = rod(ball_diameter + kPocketClearance, 0, bearing.outer_diameter).placed(turn_y(90));
  BearingProducts products;
  products.bodies = around_z(bearing.balls, pitch, width / 2);
  const Solid cage = band - at_each(pocket, around_z(bearing.balls, 0, width / 2));

  products.inner_ring = model.product(name + " inner ring", inner, kBrightSteel);
  products.cage = model.product(name + " cage", cage, kBrass);
  // Flats of a thirtieth of the diameter at the poles: a whole sphere is tessellated with degenerate triangles there.
  const Solid rolling_ball =
      ball(ball_diameter) & rod(2 * ball_diameter, -0.4995 * ball_diameter, 0.4995 * ball_diameter);
  products.body = model.product(name + " ball", rolling_ball, kBrightSteel);
  products.outer_ring = model.product(name + " outer ring", outer, kBrightSteel);
  return products;
}

void place_bearing(SampleModel& model, GroupId group, const BearingProducts& bearing, const Placement& placement) {
  model.place(group, bearing.inner_ring, placement);
  if (bearing.cage.index >= 0) model.place(group, bearing.cage, placement);
  for (const Placement& place : bearing.bodies) model.place(group, bearing.body, placement * place);
  model.place(group, bearing.outer_ring, placement);
}

BearingProducts make_roller_bearing(SampleModel& model, const std::string& name, const RollerBearing& bearing) {
  const double pitch = (bearing.outer_diameter + bearing.bore) / 2, width = bearing.width;
  const double roller = 0.3 * (bearing.outer_diameter - bearing.bore), rib_width = 1.5;
  const double race = (pitch - roller) / 2 - kRunningClearance, rib = race + 0.3 * roller, bore = bearing.bore / 2;
  const Solid inner = revolved({{bore, 0},
                                {rib, 0},
                                {rib, rib_width},
                                {race, rib_width},
                                {race, width - rib_width},
                                {rib, width - rib_width},
                                {rib, width},
                                {bore, width}});
  const double end = rib_width + kRunningClearance;
  BearingProducts products;
  products.bodies = around_z(bearing.rollers, pitch);
  products.inner_ring = model.product(name + " inner ring", inner, kBrightSteel);
  products.body = model.product(name + " roller", rod(roller, end, width - end), kBrightSteel);
  products.outer_ring =
      model.product(name + " outer ring",
                    tube(bearing.outer_diameter, pitch + roller + 2 * kRunningClearance, 0, width), kBrightSteel);
  return products;
}

BearingProducts make_tapered_bearing(SampleModel& model, const std::string& name, const TaperedBearing& bearing) {
  const double axis_angle = 12.5 * kPi / 180;
  const double width = bearing.width, middle = width / 2, length = 0.7 * width;
  const double mean_radius = (bearing.outer_diameter + bearing.bore) / 4;
  const double roller_radius = 0.13 * (bearing.outer_diameter - bearing.bore);
  const double half_angle = std::atan(roller_radius * std::sin(axis_angle) / mean_radius);
  const double apex = middle + mean_radius / std::tan(axis_angle);
  auto race = [&](double z, double angle) { return (apex - z) * std::tan(angle); };
  auto inner_race = [&](double z) { return race(z, axis_angle - half_angle); };
  auto outer_race = [&](double z) { return race(z, axis_angle + half_angle); };

  const double low = middle - length / 2 - 1.2 * roller_radius * std::sin(axis_angle), high = width;
  const double rib = inner_race(0) + 0.45 * (mean_radius - inner_race(middle));
  const double bore = bearing.bore / 2;
  const Solid inner = revolved({{bore, 0},
                                {rib, 0},
                                {rib, low - 0.3},
                                {inner_race(low - 0.3), low - 0.3},
                                {inner_race(high), high},
                                {bore, high}});
  const Solid outer = revolved({{outer_race(0.1 * width), 0.1 * width},
                                {bearing.outer_diameter / 2, 0.1 * width},
                                {bearing.outer_diameter / 2, width},
                                {outer_race(width), width}});

  // Along its own axis, the distance of a point from the apex gives the roller's radius.
  const double reach = mean_radius / std::sin(axis_angle);
  auto roller_diameter = [&](double z) {
    return 2 * ((reach - z) * std::sin(half_angle) / std::cos(half_angle) - kRunningClearance);
  };
  const double half = length / 2 / std::cos(axis_angle);
  const Solid roller = cone(roller_diameter(-half), roller_diameter(half), -half, half);
  const Solid pocket = cone(roller_diameter(-half - 0.2) + kPocketClearance,
                            roller_diameter(half + 0.2) + kPocketClearance, -half - 0.2, half + 0.2);

  BearingProducts products;
  for (const Placement& place : around_z(bearing.rollers, 2 * mean_radius, middle))
    products.bodies.push_back(place * turn_y(-axis_angle * 180 / kPi));
  const double band = 0.12 * (mean_radius - inner_race(middle)) + 0.4, ring = 0.08 * width;
  const double z0 = middle - length / 2 - ring, z1 = middle + length / 2 + ring;
  auto centre = [&](double z) { return race(z, axis_angle); };
  const Solid strip =
      revolved({{centre(z0) - band, z0}, {centre(z0) + band, z0}, {centre(z1) + band, z1}, {centre(z1) - band, z1}});
  const Solid cage = strip - at_each(pocket, products.bodies);

  products.inner_ring = model.product(name + " cone", inner, kBrightSteel);
  products.cage = model.product(name + " cage", cage, kBrass);
  products.body = model.product(name + " roller", roller, kBrightSteel);
  products.outer_ring = model.product(name + " cup", outer, kBrightSteel);
  return products;
}

}  // namespace dismantle::samples
