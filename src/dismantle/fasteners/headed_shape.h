// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/fasteners/axial_sections.h"
#include "dismantle/fasteners/fastener.h"

#include <cstdint>
#include <optional>

namespace dismantle {

/// A recess for a tool in an end of a solid.
struct DriveRecess {
  Fastener::Drive drive = Fastener::Drive::None;  ///< Its form; None if it is round or there is none.
  double size = 0;  ///< Across flats, or the outer diameter of the lobes [mm]; 0 for slots and crosses.
};

/// A solid of revolution with a head at one end and a shank at the other.
struct HeadedShape {
  Vec3 axis;                                    ///< From the tip to the head; unit.
  double head_radius = 0;                       ///< Largest distance from the axis [mm].
  double shank_radius = 0;                      ///< Of the cylinder or the thread's crests [mm].
  double head_height = 0;                       ///< From below the head to its top [mm].
  double shank_length = 0;                      ///< From below the head, or the end of its cone, to the tip [mm].
  double total_length = 0;                      ///< [mm]
  Fastener::Head head = Fastener::Head::Other;  ///< Its form.
  DriveRecess recess;                           ///< In the top of the head.
  double across_flats = 0;                      ///< Of the outer hexagon; 0 if it has none [mm].
};

/// The headed shape that a mesh is about an axis; nothing if it is none, or is hollow all along.
/// @param sections of the mesh about the axis
std::optional<HeadedShape> headed_shape(const TriangleMesh& mesh, const FastenerAxis& axis,
                                        const std::vector<AxialSection>& sections);

/// An end of an axis.
enum class AxisEnd : std::uint8_t {
  Begin,  ///< Where positions along it are smallest.
  End,    ///< Where positions along it are largest.
};

/// The recess in an end of a mesh; of no drive if there is none, or it goes through.
/// @param sections of the mesh about the axis
DriveRecess drive_recess(const TriangleMesh& mesh, const FastenerAxis& axis, const std::vector<AxialSection>& sections,
                         AxisEnd end);

}  // namespace dismantle
