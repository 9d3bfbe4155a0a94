// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/files/text_name.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The bytes of a file for a parser, and its name for messages.
struct MeshSource {
  std::string_view bytes;  ///< The whole file.
  std::string name;        ///< File name without its folder.
};

/// A mesh as a file gives it: in the file's units, not welded or cleaned; every index is below the vertex count.
struct MeshPart {
  std::string name;      ///< Empty if the file gives none.
  TriangleMesh mesh;     ///< In the file's units.
  Color color;           ///< Of the whole part.
  std::string material;  ///< OBJ: the name of its material; else empty.
};

/// The Error for a file that violates its format; `why` says where and how.
inline Error malformed(const MeshSource& source, std::string_view format, std::string_view why) {
  return {ErrorKind::Unreadable,
          source.name + " cannot be read as " + std::string(format) + " (" + std::string(why) + "); export it again"};
}

/// The Error for a file that cannot be read as `format`, of one that says "<why>; <what to do>".
inline Error unreadable_as(const std::filesystem::path& file, std::string_view format, const Error& error) {
  const std::size_t end = error.message.rfind("; ");
  const std::string advice = end == std::string::npos ? "check the file" : error.message.substr(end + 2);
  return {ErrorKind::Unreadable, file.string() + " cannot be read as " + std::string(format) + " (" +
                                     error.message.substr(0, end) + "); " + advice};
}

/// The Error for work that its progress callback cancelled.
inline Error cancelled() {
  return {ErrorKind::Failed, "cancelled"};
}

}  // namespace dismantle
