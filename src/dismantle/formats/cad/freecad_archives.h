// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/files/zip_archive.h"
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/import/imported_assembly.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The archives of a FreeCAD document and of those that it links to, opened when they are first read.
class FreeCadArchives {
 public:
  /// @param source the document, whose bytes are at hand; must outlive this @param options of the import: the largest
  /// linked file, and where linked files may be
  FreeCadArchives(const CadSource& source, const ImportOptions& options);

  /// The path of the document.
  const std::filesystem::path& root() const { return root_; }
  /// The bytes of an entry of a document. Errors: Unreadable, "<why>; <what to do>".
  Result<std::string> read(const std::filesystem::path& file, const std::string& entry);
  /// The documents that were read, other than root().
  std::vector<LinkedFile> linked_files() const;

 private:
  struct Open {
    std::string bytes;  // of a linked file
    std::optional<ZipArchive> archive;
  };

  Result<Done> open(const std::filesystem::path& file, Open& open);

  const CadSource& source_;
  std::filesystem::path root_;
  std::size_t file_limit_;
  std::vector<std::filesystem::path> folders_;  // see reference_folders()
  std::map<std::filesystem::path, Open> open_;
};

}  // namespace dismantle
