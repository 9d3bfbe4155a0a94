// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/scene_assembly.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The bytes of an entry of a FreeCAD file (a zip archive). Errors: "<why>; <what to do>".
using FreeCadEntryReader =
    std::function<Result<std::string>(const std::filesystem::path& file, const std::string& entry)>;

/// A shape of a document: a BREP file in it, in the frame of its object.
struct FreeCadShape {
  std::filesystem::path file;  ///< The document.
  std::string entry;           ///< Name of the BREP file in it.
  std::optional<Color> color;  ///< None if the document gives none.
};

/// The visible objects of a document, and of those that it links to. A scene's mesh is an index into `shapes`.
struct FreeCadScene {
  Scene scene;                       ///< [mm]. Nodes are named by the objects' labels. No node is its own ancestor.
  std::vector<FreeCadShape> shapes;  ///< Each once, whatever the number of its occurrences.
};

/// Reads the objects of a FreeCAD document: what is visible and not made into another feature; of a body, its result;
/// groups and parts as nodes; links and arrays of links as occurrences, also of objects in other documents. Errors:
/// Unreadable, "<why>; <what to do>": also for links in a circle, to missing objects or files.
Result<FreeCadScene> read_freecad_scene(const std::filesystem::path& file, const FreeCadEntryReader& read);

}  // namespace dismantle
