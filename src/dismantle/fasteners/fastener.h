// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/math/vec3.h"

#include <string>

namespace dismantle {

/// A fastener as its shape and its name tell: what it is, its size, and the tool that turns it.
struct Fastener {
  /// The kind of a fastener.
  enum class Kind {
    Screw,     ///< Screw or bolt with a head, or a set screw.
    Nut,       ///< Hexagon nut, also with flange or locking insert; ring nut.
    Washer,    ///< Plain washer or shim ring.
    Circlip,   ///< Retaining ring in a groove.
    Dowel,     ///< Plain or grooved cylindrical pin.
    Rivet,     ///< Solid rivet.
    Insert,    ///< Threaded insert that is pressed, moulded or melted in.
    Standoff,  ///< Hexagonal spacer with threads at its ends.
  };
  /// The form of a screw's head.
  enum class Head {
    None,         ///< Not a screw, or a set screw.
    Cylinder,     ///< Socket head cap screw, cheese head.
    Hexagon,      ///< Outer hexagon.
    Button,       ///< Domed: button head, pan head, round head.
    Countersunk,  ///< Conical below.
    Other,        ///< Thumb screws, eye bolts.
  };
  /// The form that the tool grips.
  enum class Drive {
    None,       ///< None that was modelled.
    Hexagon,    ///< Outer hexagon: a spanner (wrench).
    HexSocket,  ///< Inner hexagon: a hex key.
    Cross,      ///< Cross recess: a Phillips or Pozidriv screwdriver.
    Slot,       ///< Slot: a flat screwdriver.
    Torx,       ///< Hexalobular socket: a Torx key.
  };

  Kind kind = Kind::Screw;    ///< The kind.
  Head head = Head::None;     ///< Of a screw.
  Drive drive = Drive::None;  ///< Of a screw or a nut.
  /// Nominal diameter: of the thread of screws, nuts, inserts and standoffs and of the screw that a washer is for; of
  /// pins and rivets; of the shaft that a circlip is for [mm]; 0 where it is unknown.
  double diameter = 0;
  /// Length: of screws as in their designation (below the head; all of it for countersunk heads and set screws), of
  /// pins, rivets and inserts; of the hexagon of standoffs; thickness of nuts and washers [mm].
  double length = 0;
  double pitch = 0;  ///< Of the thread: as modelled, else ISO coarse for the diameter [mm]; 0 without a thread.
  /// Width across flats of the hexagon [mm]; number of the Phillips or Torx key; 0 where it is unknown.
  double drive_size = 0;
  bool thread_is_modelled = false;  ///< True if the mesh has the thread's flanks.
  bool left_handed = false;         ///< True if the modelled thread is left-handed.
  bool by_name_only = false;        ///< True if only the name tells what it is.
  Vec3 point;                       ///< On its axis [mm, frame of the mesh].
  Vec3 axis;  ///< Unit: of screws from the tip to the head; of all others of either sign [frame of the mesh].

  friend bool operator==(const Fastener&, const Fastener&) = default;
};

/// The designation for a parts list: "M5x16", "M5", "4x20" for pins, "14" for circlips, "6.35x20" for threads that are
/// none of ISO 261; empty where the size is unknown.
std::string designation_text(const Fastener& fastener);

/// The kind in one or two words: "socket head screw", "hexagon screw", "set screw", "nut", "washer".
std::string kind_text(const Fastener& fastener);

/// The kind and the designation: "socket head screw M5x16".
std::string fastener_text(const Fastener& fastener);

/// The tool that turns it: "4 mm hex key", "8 mm spanner (wrench)", "Phillips screwdriver PH2"; empty where its drive
/// is unknown or it has none.
std::string tool_text(const Fastener& fastener);

/// The drive as JSON values name it: "none", "hexagon", "hex_socket", "cross", "slot", "torx".
const char* drive_name(Fastener::Drive drive);

/// The kind as JSON values name it: "screw", "nut", "washer", "circlip", "dowel", "rivet", "insert", "standoff".
const char* kind_name(Fastener::Kind kind);

/// The head as JSON values name it: "none", "cylinder", "hexagon", "button", "countersunk", "other".
const char* head_name(Fastener::Head head);

}  // namespace dismantle
