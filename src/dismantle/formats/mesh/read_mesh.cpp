// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_mesh.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/referenced_file.h"
#include "dismantle/formats/mesh/read_obj.h"
#include "dismantle/formats/mesh/read_ply.h"
#include "dismantle/formats/mesh/read_stl.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestMaterialFile = std::size_t{64} << 20;

std::string extension_of(const fs::path& file) {
  return lower_case(file.extension().string());
}

/// Sets the colours of parts from the material files beside an OBJ file; missing files are ignored. Returns all of
/// these files.
std::vector<LinkedFile> apply_materials(ObjModel& model, const fs::path& obj, const ImportOptions& options) {
  std::vector<LinkedFile> files;
  for (const std::string& name : model.material_files) {
    files.push_back({fs::absolute(obj).parent_path() / fs::path(name).filename(), {}});
    const Result<fs::path> file =
        referenced_file(fs::path(name).filename(), obj.parent_path(), reference_folders(obj, options));
    if (!file) continue;
    const Result<std::string> text = read_file(*file, kLargestMaterialFile);
    if (!text) continue;
    files.back() = {fs::absolute(*file), sha256(*text)};
    const std::unordered_map<std::string, Color> colors = parse_mtl(*text);
    for (MeshPart& part : model.parts)
      if (const auto color = colors.find(part.material); color != colors.end()) part.color = color->second;
  }
  return files;
}

/// The parts of a file and what it refers to, without its bytes.
Result<MeshFile> parse_parts(const fs::path& file, const MeshSource& source, const ImportOptions& options) {
  const std::string extension = extension_of(file);
  MeshFile mesh;
  if (extension == ".stl") {
    Result<std::vector<MeshPart>> parts = parse_stl(source, options);
    if (!parts) return parts.error();
    mesh.parts = std::move(*parts);
  } else if (extension == ".ply") {
    Result<MeshPart> part = parse_ply(source, options);
    if (!part) return part.error();
    mesh.parts.push_back(std::move(*part));
  } else {
    Result<ObjModel> model = parse_obj(source, options);
    if (!model) return model.error();
    mesh.linked_files = apply_materials(*model, file, options);
    mesh.parts = std::move(model->parts);
  }
  return mesh;
}

/// All parts as one mesh, with the first one's colour.
MeshPart merged(std::vector<MeshPart> parts, std::string name) {
  MeshPart whole = parts.empty() ? MeshPart{} : std::move(parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(whole.mesh.vertices.size());
    const TriangleMesh& mesh = parts[i].mesh;
    whole.mesh.vertices.insert(whole.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Face& f : mesh.faces) whole.mesh.faces.push_back({{first + f.v[0], first + f.v[1], first + f.v[2]}});
  }
  whole.name = std::move(name);
  return whole;
}

Result<std::vector<fs::path>> mesh_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (is_mesh_file(entry->path()) && entry->is_regular_file()) files.push_back(entry->path());
  if (error)
    return Error{ErrorKind::Unreadable,
                 folder.string() + " cannot be read (" + error.message() + "); check the path and its permissions"};
  if (files.empty())
    return Error{ErrorKind::Unreadable,
                 folder.string() + " holds no mesh (no .obj, .stl or .ply file in it); name the folder of the meshes"};
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.filename().native() < b.filename().native(); });
  return files;
}

/// The folder's own name, also if the path ends with a slash or is ".".
std::string folder_name(const fs::path& folder) {
  std::error_code ignored;
  const fs::path whole = fs::canonical(folder, ignored);
  return whole.has_filename() ? whole.filename().string() : folder.string();
}

}  // namespace

bool is_mesh_file(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".obj" || extension == ".stl" || extension == ".ply";
}

Result<MeshFile> read_mesh_file(const fs::path& file, const ImportOptions& options) {
  DISMANTLE_EXPECT(is_mesh_file(file));
  Result<std::string> bytes = read_file(file, options.limits.file_bytes);
  if (!bytes) return bytes.error();
  Result<MeshFile> mesh = parse_parts(file, {*bytes, file.filename().string()}, options);
  if (!mesh) return mesh;
  mesh->bytes = std::move(*bytes);
  for (MeshPart& part : mesh->parts)
    if (part.name.empty()) part.name = file.stem().string();
  return mesh;
}

Result<Assembly> read_mesh(const fs::path& file, const ImportOptions& options) {
  Result<AssemblyBuilder> builder = AssemblyBuilder::create(file.filename().string(), "mm", options);
  if (!builder) return builder.error();
  Result<MeshFile> mesh = read_mesh_file(file, options);
  if (!mesh) return mesh.error();
  for (MeshPart& part : mesh->parts)
    if (auto error = builder->add(std::move(part))) return *error;
  return builder->finish(sha256(mesh->bytes));
}

Result<Assembly> read_mesh_folder(const fs::path& folder, const ImportOptions& options) {
  Result<AssemblyBuilder> builder = AssemblyBuilder::create(folder_name(folder), "mm", options);
  if (!builder) return builder.error();
  const Result<std::vector<fs::path>> files = mesh_files_in(folder);
  if (!files) return files.error();

  Sha256 hash;
  ImportOptions file_options = options;  // the whole folder's progress is reported here, a file at a time
  file_options.progress = nullptr;
  for (std::size_t i = 0; i < files->size(); ++i) {
    const fs::path& file = (*files)[i];
    if (!report_progress(options.progress, "reading", static_cast<double>(i) / static_cast<double>(files->size())))
      return cancelled();
    Result<MeshFile> mesh = read_mesh_file(file, file_options);
    if (!mesh) return mesh.error();
    hash.update(mesh->bytes);
    if (auto error = builder->add(merged(std::move(mesh->parts), file.stem().string()))) return *error;
  }
  return builder->finish(hash.finish());
}

}  // namespace dismantle
