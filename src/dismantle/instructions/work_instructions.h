// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/export/path_animations.h"
#include "dismantle/render/image.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// Equal components, counted.
struct CountedPart {
  std::size_t item = 0;  ///< Of the parts list, from 0.
  std::size_t count = 0;
};

/// A line of the parts list.
struct PartsLine {
  std::string name;
  std::size_t count = 0;
  Vec3 size;                       ///< Of the box around it [mm].
  std::vector<std::size_t> steps;  ///< In which some of them are handled, from 1.
};

/// What is to be known about a step, as a sentence.
struct InstructionNote {
  enum class Kind { Way, Tool, Warning, Clearance, Overlap };
  Kind kind = Kind::Way;
  std::string text;
};

/// One step for the fitter.
struct Instruction {
  std::string title;  ///< "Unscrew 4 x bolt".
  std::vector<CountedPart> parts;
  std::vector<InstructionNote> notes;  ///< Ordered by kind.
  Image picture;
  std::optional<Image> overview;  ///< Where on the whole it is, if the picture shows only a part.
};

/// Work instructions: what a document of any form says.
struct WorkInstructions {
  std::string title;     ///< "Disassembly of vice.step".
  std::string assembly;  ///< Its file and the first digits of its checksum.
  Image cover;
  std::vector<PartsLine> parts;
  std::vector<std::string> tools;    ///< All that are wanted, by kind and size.
  std::vector<std::string> staying;  ///< Components that no step moves.
  std::vector<Instruction> steps;
};

struct WorkInstructionsOptions {
  PathDirection direction = PathDirection::Forward;
  std::string product;       ///< That titles name; empty: the assembly's file.
  int picture_width = 960;   ///< [pixels]
  int picture_height = 720;  ///< [pixels]
  CertificateOptions engine;
  ProgressCallback progress;
};

/// Instructions for taking an assembly apart along a path, or together again. z is up. Tools and warnings are of the
/// shapes and the motion alone: threads, hexagons, fits, what could fall. Same input, same result.
/// @pre the timeline is of the assembly; pairs are its own
/// Errors: Usage where the path has no moves, Failed where it was cancelled.
Result<WorkInstructions> work_instructions(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
                                           const WorkInstructionsOptions& options = {});

/// "Way", "Tools", ...: the heading of a kind of notes.
const char* heading_of(InstructionNote::Kind kind);

/// "4 x bolt (item 7)", as the step's list of parts has it.
std::string part_text(const WorkInstructions& instructions, const CountedPart& part);
/// "12 x 8 x 5", of a box [mm].
std::string size_text(const Vec3& size);
/// How much there is to do, and of what file: for the cover.
std::string summary_text(const WorkInstructions& instructions);

/// What a document says of how the instructions were made.
inline constexpr const char* kInstructionsFooter =
    "Tools and warnings are derived from shapes and motions alone; up is +Z. Clearances are measured at places along "
    "the way: between them it may come nearer. Friction, weight, glue and what is not drawn are not known. Written by "
    "dismantle.";

}  // namespace dismantle
