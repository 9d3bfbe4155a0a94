// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/fastener.h"
#include "dismantle/fasteners/headed_shape.h"

namespace dismantle {

/// True if two sizes differ by at most this share of the second; false if that is 0.
bool is_near(double a, double b, double share);

/// A measured length, rounded to half a millimetre if it is within 1% and 0.06 mm of it, else to a hundredth [mm].
double rounded_length(double length);

/// The nominal diameter of a thread whose crests have a diameter [mm]: within 3%, or above it where the model is of the
/// root or the pitch diameter; head and drive decide between sizes. Rounded as it is if no size fits.
/// @param shape of the screw, or null
double screw_diameter(double measured, const HeadedShape* shape);

/// The size of the tool for a drive: Fastener::drive_size. @param measured across flats, or over the lobes [mm]
/// @param diameter nominal, of the thread [mm]
double drive_size(Fastener::Drive drive, Fastener::Head head, double measured, double diameter);

/// The thread that a washer with a hole is for: the largest that goes through [mm]; 0 if there is none.
double washer_for(double hole);

/// The thread of an insert with a hole, drawn at the nominal or the minor diameter: the nearest [mm].
double insert_for(double hole);

}  // namespace dismantle
