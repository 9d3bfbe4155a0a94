// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/write_assembly.h"

#include "dismantle/assembly/assembly_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/gltf/write_glb.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/mesh/write_mesh.h"

namespace dismantle {

Result<Done> write_assembly(const std::filesystem::path& file, const Assembly& assembly, const WriteOptions& options,
                            const Motion* motion) {
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".dasm") return write_file(file, assembly_file_bytes(assembly, motion));
  if (motion != nullptr)
    return Error{ErrorKind::Usage,
                 "the motion cannot be kept (" + file.string() + " is no .dasm file); end its name with .dasm"};
  if (extension == ".obj") return write_obj(file, assembly);
  if (extension == ".stl") return write_stl(file, assembly, options.stl);
  if (extension == ".ply") return write_ply(file, assembly);
  if (extension == ".glb") return write_glb(assembly, file);
  if (extension.empty() || !file.has_filename()) return write_mesh_folder(file, assembly);
  return Error{ErrorKind::Usage, file.string() + " cannot be written (unknown extension " + in_quotes(extension) +
                                     "); end it with .obj, .stl, .ply, .glb or .dasm, or with nothing for a folder"};
}

}  // namespace dismantle
