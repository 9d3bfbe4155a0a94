// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"
#include "dismantle/fasteners/fastener.h"

#include <optional>

namespace dismantle {

/// The standard dimensions for one nominal size of metric threads. 0 where a standard does not have the size. All in
/// mm.
struct ThreadSize {
  double diameter = 0;       ///< Nominal: M3 is 3.
  double pitch = 0;          ///< ISO 261, coarse.
  double hexagon = 0;        ///< Width across flats of hexagon heads and nuts: ISO 4014, 4032.
  double hexagon_din = 0;    ///< The same in DIN 931, 934, where it differs.
  double cylinder_head = 0;  ///< Diameter of socket head cap screws: ISO 4762.
  double cylinder_key = 0;   ///< Their hex key.
  double button_head = 0;    ///< Diameter of button heads: ISO 7380-1.
  double button_key = 0;     ///< Their hex key; also that of countersunk heads, ISO 10642.
  double set_screw_key = 0;  ///< Hex key of set screws: ISO 4026.
  double pan_head = 0;       ///< Diameter of pan heads with cross recess: ISO 7045.
  int cross = 0;             ///< Number of their cross recess: PH0 to PH4.
  double washer_outer = 0;   ///< Outer diameter of normal washers: ISO 7089.
  double washer_hole = 0;    ///< Their hole.
};

/// All sizes from M1 to M64, ascending.
Span<const ThreadSize> thread_sizes();

/// The size of a nominal diameter within 1%; nothing if there is none.
const ThreadSize* thread_size(double diameter);

/// The number of the Torx key of a socket whose lobes have this outer diameter [mm]; 0 if none is near.
double torx_number(double outer_diameter);

/// The shaft diameter that a circlip of this inner diameter is for: DIN 471 [mm]; 0 if none is near.
double circlip_shaft(double inner_diameter);

/// A standard diameter of dowels near this one: ISO 2338, 8734, or of inches [mm]; 0 if none is within 1%.
double dowel_diameter(double diameter);

/// True if dowels of this standard diameter are made in this length within 1%: ISO 2338, 8734, or sixteenths of an
/// inch for diameters of inches.
bool is_dowel_length(double diameter, double length);

/// The standard width across flats near a measured one, within 3% [mm]; the measured one if there is none.
double nominal_width(double across_flats);

}  // namespace dismantle
