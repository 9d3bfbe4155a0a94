// SPDX-License-Identifier: Apache-2.0
#include "bench/assembly_input.h"

#ifndef DISMANTLE_CORE_ONLY
#include "dismantle/documents/motion_file.h"
#include "dismantle/loading/load_assembly.h"
#endif

namespace dismantle {

namespace {

#ifdef DISMANTLE_CORE_ONLY
Result<AssemblyFile> read_other_format(const std::filesystem::path& file) {
  return Error{ErrorKind::Unreadable,
               file.string() +
                   " cannot be read (this build reads .dasm files only); convert it with a whole "
                   "dismantle: dismantle convert FILE -o FILE.dasm"};
}
#else
Result<AssemblyFile> read_other_format(const std::filesystem::path& file) {
  Result<Assembly> assembly = load_assembly(file);
  if (!assembly) return assembly.error();
  AssemblyFile input{std::move(*assembly), std::nullopt};
  const std::filesystem::path motion_file = std::filesystem::path(file).replace_extension(".motion.json");
  if (!std::filesystem::exists(motion_file)) return input;
  Result<Motion> motion = read_motion(motion_file);
  if (!motion) return motion.error();
  input.motion = std::move(*motion);
  return input;
}
#endif

}  // namespace

Result<AssemblyFile> read_assembly_input(const std::filesystem::path& file) {
  return file.extension() == ".dasm" ? read_assembly_file(file) : read_other_format(file);
}

Result<AssemblyFile> read_sample_input(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path binary = folder / (name + ".dasm");
  return read_assembly_input(std::filesystem::exists(binary) ? binary : folder / (name + ".step"));
}

}  // namespace dismantle
