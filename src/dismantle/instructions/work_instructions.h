// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/core/progress.h"
#include "dismantle/core/result.h"
#include "dismantle/export/path_animations.h"
#include "dismantle/instructions/exploded_overview.h"
#include "dismantle/instructions/instruction_names.h"
#include "dismantle/render/image.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dismantle {

/// A number of equal components.
struct CountedPart {
  std::size_t item = 0;   ///< Index into the parts list, from 0.
  std::size_t count = 0;  ///< Number of components.
};

/// A line of the parts list.
struct PartsLine {
  std::string name;                ///< Name of the part; "item 7" if the document cannot show it.
  std::size_t count = 0;           ///< Number of components.
  Vec3 size;                       ///< Of the bounding box [mm].
  std::vector<std::size_t> steps;  ///< Steps that handle some of them, from 1.
  std::string label = {};          ///< In running text (InstructionNames::of_item()). Empty: the name.
  std::string fastener = {};       ///< "socket head screw M5x16"; empty if it is none, or its name says its size.
};

/// A note of a step.
struct InstructionNote {
  /// Subjects of notes, in the order in which they are listed.
  enum class Kind { Motion, Tool, Warning, Clearance, Overlap };
  Kind kind = Kind::Motion;  ///< Selects the heading.
  std::string text;          ///< One or more sentences.
};

/// The identification of a document; empty members are left out.
struct TitleBlock {
  std::string number;    ///< Of the document or the part.
  std::string revision;  ///< "B".
  std::string author;    ///< Who made it.
  std::string date;      ///< ISO 8601: "2026-11-25".
};

/// One step of the instructions.
struct Instruction {
  std::string title;                   ///< "Unscrew 4 x bolt".
  std::vector<CountedPart> parts;      ///< The components that move.
  std::vector<InstructionNote> notes;  ///< Ordered by kind.
  Image picture;                       ///< The moving components and their surroundings.
  std::optional<Image> overview;       ///< All of the surroundings, if the picture shows only a part of them.
  Vec3 view = {};                      ///< Viewing direction of the pictures; unit vector. Zero: unknown.
};

/// The content of work instructions, independent of the document format.
struct WorkInstructions {
  std::string title;                    ///< "Disassembly of vice.step".
  std::string assembly;                 ///< Its file and the first digits of its checksum.
  TitleBlock title_block;               ///< As in the options.
  Image cover;                          ///< The assembled product.
  ExplodedOverview exploded;            ///< The product exploded, with balloons of the parts list.
  std::vector<PartsLine> parts;         ///< The parts list.
  std::vector<std::string> tools;       ///< All tools that are needed, by kind and size.
  std::vector<std::string> stationary;  ///< Names of the components that no step moves.
  std::vector<Instruction> steps;       ///< In the order in which they are carried out.
  std::string missing_glyphs;           ///< Characters of names that cannot be shown; item numbers stand for the names.
};

/// Options of work_instructions().
struct WorkInstructionsOptions {
  PathDirection direction = PathDirection::Forward;  ///< Disassembly, or reversed: assembly.
  std::string product;                               ///< Product name in titles; empty: the assembly's file.
  TitleBlock title_block;                            ///< For the cover and the footers.
  MissingGlyphs missing_glyphs;                      ///< Of the document; empty: it shows all characters.
  int picture_width = 960;                           ///< [pixels]
  int picture_height = 720;                          ///< [pixels]
  CertificateOptions engine;  ///< Options of the engine that measures clearances and checks support.
  ProgressCallback progress;  ///< Reports and cancels.
};

/// Makes instructions for disassembling a product along a path, or for assembling it. z is up. Tools and warnings are
/// derived from shapes and motions alone: threads, hexagons, fits, loss of support. Deterministic.
/// @pre the timeline and the pairs belong to the assembly
/// Errors: Usage if the path has no moves, Failed if cancelled.
Result<WorkInstructions> work_instructions(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
                                           const WorkInstructionsOptions& options = {});

/// The heading of a kind of notes: "Motion", "Tools", ...
const char* heading_of(InstructionNote::Kind kind);

/// A number of equal components in running text: "4 x bolt", or "bolt" for a single one.
std::string counted_name(const WorkInstructions& instructions, const CountedPart& part);
/// An entry of a step's list of parts: "4 x bolt (item 7)".
std::string part_text(const WorkInstructions& instructions, const CountedPart& part);
/// The name of a part, and what fastener it is: "bolt, socket head screw M5x16".
std::string part_name_text(const PartsLine& line);
/// The size of a box [mm]: "12 x 8 x 5".
std::string size_text(const Vec3& size);
/// The entries of a title block that are not empty, with their headings: "Revision" and "B".
std::vector<std::pair<std::string, std::string>> title_block_entries(const TitleBlock& block);
/// The summary on the cover: numbers of steps, components and kinds, and the source file.
std::string summary_text(const WorkInstructions& instructions);

/// Footer of a document: basis and limits of the instructions.
inline constexpr const char* kInstructionsFooter =
    "Tools and warnings are derived from shapes and motions alone; up is +Z. Clearances are measured at samples along "
    "the "
    "path and may be smaller in between. Friction, weight, adhesives and parts that are not modelled are not "
    "considered. "
    "Written by dismantle.";

}  // namespace dismantle
