// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/span.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The formats of files that hold assemblies.
enum class FileFormat { Step, Iges, Brep, FreeCad, Gltf, ThreeMf, Collada, Vrml, Urdf, Dasm, Obj, Stl, Ply };

/// A format, and how its files are recognised.
struct FormatEntry {
  FileFormat format;                         ///< Which one it is.
  std::string_view name;                     ///< For users: "STEP".
  std::vector<std::string_view> extensions;  ///< In lower case, with the dot.
  bool is_part = false;    ///< One part a file: the files of a folder together are an assembly (OBJ, STL, PLY).
  bool has_links = false;  ///< A file may refer to other files.
  /// Read by OpenCASCADE or Assimp, itself or the files that it refers to, which takes time: the result is kept in the
  /// cache.
  bool by_cad_kernel = false;
};

/// All formats that dismantle reads: the one list of them, in the order in which users are told.
Span<const FormatEntry> file_formats();

/// The format of a file by its extension, in upper or lower case; null for any other file.
const FormatEntry* format_of(const std::filesystem::path& file);

/// The names of all formats, for a sentence: "STEP, IGES, ..., STL or PLY".
std::string format_names(std::string_view before_last = " or ");

}  // namespace dismantle
