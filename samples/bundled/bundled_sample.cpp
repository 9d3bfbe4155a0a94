// SPDX-License-Identifier: Apache-2.0
#include "samples/bundled/bundled_sample.h"

#include <zlib.h>
#include <cstdint>
#include <cstring>

// The assembler takes the packed files in whole; pack_file.cpp made them. (Their paths come from CMake.)
#define DISMANTLE_EMBED(symbol, file)                                                                                 \
  __asm__(".section .rodata\n.balign 8\n" #symbol ":\n.incbin \"" file "\"\n" #symbol "_end:\n.byte 0\n.previous\n"); \
  extern "C" __attribute__((visibility("hidden"))) const unsigned char symbol[], symbol##_end[]

DISMANTLE_EMBED(dismantle_microscope_step, DISMANTLE_PACKED "/microscope.step.packed");
DISMANTLE_EMBED(dismantle_microscope_motion, DISMANTLE_PACKED "/microscope.motion.json.packed");
DISMANTLE_EMBED(dismantle_tooling_step, DISMANTLE_PACKED "/tooling.step.packed");
DISMANTLE_EMBED(dismantle_tooling_motion, DISMANTLE_PACKED "/tooling.motion.json.packed");
DISMANTLE_EMBED(dismantle_lathe_step, DISMANTLE_PACKED "/lathe.step.packed");
DISMANTLE_EMBED(dismantle_lathe_motion, DISMANTLE_PACKED "/lathe.motion.json.packed");
DISMANTLE_EMBED(dismantle_robot_step, DISMANTLE_PACKED "/robot.step.packed");
DISMANTLE_EMBED(dismantle_robot_motion, DISMANTLE_PACKED "/robot.motion.json.packed");

namespace dismantle {

namespace {

/// A packed file: its unpacked size (8 bytes, little endian), then a zlib stream.
struct Packed {
  const unsigned char* begin;
  const unsigned char* end;
};

struct Entry {
  BundledSample sample;
  Packed step, motion;
};

const Entry kEntries[] = {
    {{"microscope", "laboratory microscope: dovetail focus, rack and pinion, objective turret"},
     {dismantle_microscope_step, dismantle_microscope_step_end},
     {dismantle_microscope_motion, dismantle_microscope_motion_end}},
    {{"tooling", "two-plate injection mould: guide pillars, ejectors, inserts, sprue, cooling"},
     {dismantle_tooling_step, dismantle_tooling_step_end},
     {dismantle_tooling_motion, dismantle_tooling_motion_end}},
    {{"lathe", "bench lathe: spindle in roller bearings, three-jaw chuck, lead screw, tool turret, tailstock"},
     {dismantle_lathe_step, dismantle_lathe_step_end},
     {dismantle_lathe_motion, dismantle_lathe_motion_end}},
    {{"robot", "six-axis arm: planetary gear stages, bearings, motors, gripper on linear guides"},
     {dismantle_robot_step, dismantle_robot_step_end},
     {dismantle_robot_motion, dismantle_robot_motion_end}},
};

Result<std::string> unpacked(Packed packed) {
  std::uint64_t size = 0;
  for (int i = 7; i >= 0; --i) size = size << 8 | packed.begin[i];
  std::string text(size, '\0');
  uLongf length = size;
  const unsigned char* stream = packed.begin + 8;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(text.data()), &length, stream, static_cast<uLong>(packed.end - stream));
  if (status != Z_OK || length != size)
    return Error{ErrorKind::Failed,
                 "a bundled sample cannot be unpacked (the program file is damaged); install it again"};
  return text;
}

Result<const Entry*> find_entry(std::string_view name) {
  std::string known;
  for (const Entry& entry : kEntries) {
    if (entry.sample.name == name) return &entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.sample.name);
  }
  return Error{ErrorKind::Usage,
               "no sample is called '" + std::string(name) + "' (there are " + known + "); choose one of these"};
}

}  // namespace

std::vector<BundledSample> bundled_samples() {
  std::vector<BundledSample> samples;
  for (const Entry& entry : kEntries) samples.push_back(entry.sample);
  return samples;
}

Result<std::string> bundled_sample_step(std::string_view name) {
  const Result<const Entry*> entry = find_entry(name);
  if (!entry) return entry.error();
  return unpacked((*entry)->step);
}

Result<std::string> bundled_sample_motion(std::string_view name) {
  const Result<const Entry*> entry = find_entry(name);
  if (!entry) return entry.error();
  return unpacked((*entry)->motion);
}

}  // namespace dismantle
