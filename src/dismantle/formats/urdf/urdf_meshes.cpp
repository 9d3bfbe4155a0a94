// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/urdf_meshes.h"

#include "dismantle/files/sha256.h"
#include "dismantle/formats/collada/read_collada.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/import/referenced_file.h"
#include "dismantle/formats/mesh/read_mesh.h"

#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

constexpr double kMetresPerMillimetre = 1e-3;

/// Candidate files for `address` in a URDF in `folder`, the most likely first.
std::vector<fs::path> candidates(const std::string& address, const fs::path& folder) {
  constexpr std::string_view kFile = "file://", kPackage = "package://";
  if (address.starts_with(kFile)) return {address.substr(kFile.size())};
  if (!address.starts_with(kPackage)) return {folder / address};

  const std::string path = address.substr(kPackage.size());
  const std::size_t slash = path.find('/');
  const std::string package = path.substr(0, slash);
  const std::string inside = slash == std::string::npos ? "" : path.substr(slash + 1);
  std::vector<fs::path> files;
  fs::path above = folder;
  while (true) {
    if (above.filename() == package) files.push_back(above / inside);
    files.push_back(above / path);
    if (!above.has_relative_path()) break;
    above = above.parent_path();
  }
  above = folder;
  files.push_back(above / inside);
  if (above.has_relative_path()) files.push_back(above.parent_path() / inside);
  return files;
}

/// The folder of a file, without links and dots where it exists.
fs::path folder_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  std::error_code error;
  fs::path resolved = fs::canonical(folder, error);
  return error ? folder : resolved;
}

}  // namespace

UrdfMeshes::UrdfMeshes(const fs::path& urdf, const ImportOptions& options)
    : urdf_name_(urdf.filename().string()),
      base_(folder_of(urdf)),
      folders_(reference_folders(urdf, options)),
      options_(options) {
  options_.progress = nullptr;  // progress is reported a link at a time
}

Result<std::vector<MeshPart>> UrdfMeshes::load(const std::string& address) {
  std::string why;
  for (const fs::path& candidate : candidates(address, base_)) {
    const Result<fs::path> file = referenced_file(candidate, base_, folders_);
    if (file) return read(*file, address);
    hashes_.try_emplace(base_ / candidate);
    if (why.empty()) why = file.error().message;
  }
  return unreadable_as(urdf_name_, "URDF",
                       {ErrorKind::Unreadable, "it refers to " + in_quotes(address) + ", which " + why});
}

std::vector<LinkedFile> UrdfMeshes::linked_files() const {
  std::vector<LinkedFile> files;
  for (const auto& [file, hash] : hashes_) files.push_back({file, hash});
  return files;
}

Result<std::vector<MeshPart>> UrdfMeshes::read(const fs::path& file, const std::string& address) {
  const FormatEntry* format = format_of(file);
  if (format != nullptr && format->format == FileFormat::Collada) return read_collada_parts(file);
  if (!is_mesh_file(file))
    return malformed({{}, urdf_name_}, "URDF", "mesh " + in_quotes(address) + " is no COLLADA, OBJ, STL or PLY file");
  Result<MeshFile> mesh = read_mesh_file(file, options_);
  if (!mesh) return mesh.error();
  hashes_[file] = sha256(mesh->bytes);
  for (LinkedFile& linked : mesh->linked_files) hashes_[std::move(linked.file)] = std::move(linked.sha256);
  return std::move(mesh->parts);
}

Result<std::vector<MeshPart>> UrdfMeshes::read_collada_parts(const fs::path& file) {
  ImportOptions options = options_;
  options.units.clear();  // those of the URDF; the file has its own
  const Result<Assembly> assembly = read_collada(file, options);
  if (!assembly) return assembly.error();
  hashes_[file] = assembly->source_sha256;
  std::vector<MeshPart> parts;
  for (const Component& component : assembly->components) {
    MeshPart part{component.name, assembled_mesh(component), component.color, {}};
    for (Vec3& p : part.mesh.vertices) p *= kMetresPerMillimetre;
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace dismantle
