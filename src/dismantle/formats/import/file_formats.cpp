// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/file_formats.h"

#include "dismantle/files/text_scan.h"

#include <algorithm>

namespace dismantle {

Span<const FormatEntry> file_formats() {
  static const std::vector<FormatEntry> kFormats = {
      {FileFormat::Step, "STEP", {".step", ".stp"}, false, false, true},
      {FileFormat::Iges, "IGES", {".iges", ".igs"}, false, false, true},
      {FileFormat::Brep, "BREP", {".brep", ".brp"}, false, false, true},
      {FileFormat::FreeCad, "FCStd", {".fcstd"}, false, true, true},
      {FileFormat::Gltf, "glTF", {".gltf", ".glb"}, false, true},
      {FileFormat::ThreeMf, "3MF", {".3mf"}},
      {FileFormat::Collada, "COLLADA", {".dae"}, false, false, true},
      {FileFormat::Vrml, "VRML", {".wrl", ".vrml"}},
      {FileFormat::Urdf, "URDF", {".urdf"}, false, true, true},
      {FileFormat::Dasm, "DASM", {".dasm"}},
      {FileFormat::Obj, "OBJ", {".obj"}, true, true},
      {FileFormat::Stl, "STL", {".stl"}, true},
      {FileFormat::Ply, "PLY", {".ply"}, true},  // a line each
  };
  return kFormats;
}

const FormatEntry* format_of(const std::filesystem::path& file) {
  const std::string extension = lower_case(file.extension().string());
  for (const FormatEntry& entry : file_formats())
    if (std::find(entry.extensions.begin(), entry.extensions.end(), extension) != entry.extensions.end()) return &entry;
  return nullptr;
}

std::string format_names(std::string_view before_last) {
  std::string names;
  const Span<const FormatEntry> formats = file_formats();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (i > 0) names += i + 1 < formats.size() ? ", " : before_last;
    names += formats[i].name;
  }
  return names;
}

}  // namespace dismantle
