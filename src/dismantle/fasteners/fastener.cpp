// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener.h"

#include "dismantle/fasteners/standard_sizes.h"

#include <cmath>
#include <cstdio>

namespace dismantle {

namespace {

using Kind = Fastener::Kind;
using Head = Fastener::Head;
using Drive = Fastener::Drive;

/// A length with at most two decimals.
std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string number = text;
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number;
}

}  // namespace

std::string designation_text(const Fastener& f) {
  if (!(f.diameter > 0)) return {};
  std::string diameter = short_number(f.diameter);
  const std::string length = short_number(f.length);
  // Other diameters than those of ISO 261 are no metric thread.
  std::string thread = (thread_size(f.diameter) != nullptr ? "M" : "") + diameter;
  switch (f.kind) {
    case Kind::Screw:
    case Kind::Standoff:
    case Kind::Insert:
      return thread + (f.length > 0 ? "x" + length : "");
    case Kind::Nut:
    case Kind::Washer:
      return thread;
    case Kind::Dowel:
    case Kind::Rivet:
      return diameter + (f.length > 0 ? "x" + length : "");
    case Kind::Circlip:
      return diameter;
  }
  return {};
}

std::string kind_text(const Fastener& f) {
  if (f.kind != Kind::Screw) return kind_name(f.kind) == std::string("insert") ? "threaded insert" : kind_name(f.kind);
  switch (f.head) {
    case Head::None:
      return "set screw";
    case Head::Cylinder:
      return f.drive == Drive::HexSocket ? "socket head screw" : "cylinder head screw";
    case Head::Hexagon:
      return "hexagon head screw";
    case Head::Button:
      return f.drive == Drive::Cross ? "pan head screw" : "button head screw";
    case Head::Countersunk:
      return "countersunk screw";
    case Head::Other:
      return "screw";
  }
  return "screw";
}

std::string fastener_text(const Fastener& f) {
  const std::string designation = designation_text(f);
  return kind_text(f) + (designation.empty() ? "" : " " + designation);
}

std::string tool_text(const Fastener& f) {
  const std::string size = short_number(f.drive_size);
  const bool is_known = f.drive_size > 0;
  switch (f.drive) {
    case Drive::None:
      return {};
    case Drive::Hexagon:
      return is_known ? size + " mm spanner (wrench)" : "spanner (wrench)";
    case Drive::HexSocket:
      return is_known ? size + " mm hex key" : "hex key";
    case Drive::Cross:
      return f.diameter > 0 ? "Phillips screwdriver PH" + size : "Phillips screwdriver";
    case Drive::Slot:
      return "flat screwdriver";
    case Drive::Torx:
      return is_known ? "Torx key T" + size : "Torx key";
  }
  return {};
}

const char* drive_name(Drive drive) {
  constexpr const char* kNames[] = {"none", "hexagon", "hex_socket", "cross", "slot", "torx"};
  return kNames[static_cast<int>(drive)];
}

const char* kind_name(Kind kind) {
  constexpr const char* kNames[] = {"screw", "nut", "washer", "circlip", "dowel", "rivet", "insert", "standoff"};
  return kNames[static_cast<int>(kind)];
}

const char* head_name(Head head) {
  constexpr const char* kNames[] = {"none", "cylinder", "hexagon", "button", "countersunk", "other"};
  return kNames[static_cast<int>(head)];
}

}  // namespace dismantle
