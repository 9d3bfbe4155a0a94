// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace dismantle {

/// The programs that read models.
enum class ReaderProgram {
  Meshes,  ///< `dismantle-read`: all formats that need neither OpenCASCADE nor Assimp.
  Cad,     ///< `dismantle-read-cad`: those that do.
};

/// The path of a reader program: in the folder that the environment variable DISMANTLE_READERS names, or beside the
/// program or Python module that calls this, in `../libexec/dismantle` seen from there, where this build put it, or
/// where it is installed. Empty if it is nowhere.
std::filesystem::path find_reader(ReaderProgram program);

}  // namespace dismantle
