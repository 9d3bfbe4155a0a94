// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/scene_assembly.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// A reference to an object, perhaps of another document.
struct FreeCadLink {
  std::string file;  ///< Relative to the document's folder; empty: the document itself.
  std::string name;  ///< Of the object.
  std::string path;  ///< From the object to one below it: names with a dot after each; empty: the object itself.
};

/// The properties of an object of a FreeCAD document that say what it looks like and where it is.
struct FreeCadObject {
  std::string name;                               ///< Unique in the document.
  std::string type;                               ///< "Part::Box", "App::Link", ...
  std::string label;                              ///< What the user calls it; the name if there is none.
  SceneTransform placement;                       ///< In the group around it, or the document [mm].
  bool is_visible = true;                         ///< By itself: what is around it may be hidden.
  std::optional<Color> color;                     ///< None if the document gives none.
  std::string shape_file;                         ///< Name of the BREP file with its shape; empty if it has none.
  std::optional<std::vector<std::string>> group;  ///< Names of the objects in it, if it is a group.
  std::vector<std::string> inputs;  ///< Names of objects that it makes its shape of, and that it replaces.

  std::optional<FreeCadLink> link;    ///< What it is an occurrence of, if it is a link.
  bool adds_placement = false;        ///< Link: moves the object from where it is, rather than to where the link is.
  Vec3 scale{1, 1, 1};                ///< Link: of the object, along its axes.
  std::size_t element_count = 0;      ///< Link: if not 0, an array of that many occurrences.
  std::vector<std::string> elements;  ///< Link: the objects that are its occurrences.
  std::string placements_file;        ///< Link: name of the file of the occurrences' placements.
  std::string scales_file;            ///< Link: name of the file of their scales.
  std::string hidden_elements;        ///< Link: '0' for each occurrence that is hidden, in their order.
};

/// A FreeCAD document, as declared: names need not be those of objects.
struct FreeCadDocument {
  std::vector<FreeCadObject> objects;                  ///< In the order of the file.
  std::unordered_map<std::string, std::size_t> index;  ///< By name.
};

/// Parses Document.xml, and GuiDocument.xml for colours, and for visibility where the former does not have it;
/// `gui_xml` may be empty or malformed. Errors: Unreadable, "<why>; <what to do>", if Document.xml is no FreeCAD
/// document or a number in it is not finite.
Result<FreeCadDocument> parse_freecad_document(std::string_view document_xml, std::string_view gui_xml);

}  // namespace dismantle
