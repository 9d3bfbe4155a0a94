// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// Limits beyond which a reader returns an Error; the defaults are far above real assemblies.
struct ImportLimits {
  std::size_t file_bytes = std::size_t{4} << 30;  ///< Largest file [bytes].
  std::size_t triangles = 50'000'000;             ///< Of the whole assembly.
  std::size_t components = 100'000;               ///< Of the whole assembly.
  std::uint64_t memory_bytes = 0;  ///< Of the process that reads the file [bytes]; 0: as import_budget() has it.
  double cpu_seconds = 0;          ///< Processor time of that process [s]; 0: as import_budget() has it.
};

/// Size of ImportOptions::cache_folder, at most [bytes].
inline constexpr std::uint64_t kCacheBytes = std::uint64_t{2} << 30;

/// How a product with several solids is imported, and a URDF link with several visuals.
enum class Solids {
  Split,  ///< A component of each solid, or visual.
  Join,   ///< One component of all.
};

/// Default linear deflection, relative to the diagonal of the assembly's bounding box. One absolute value for the whole
/// assembly, as its tolerance follows from the coarsest component.
inline constexpr double kDefaultRelativeDeflection = 5e-5;
/// Default angular deflection [rad]: 20 degrees, 18 sides to a full turn. Refines small round features of large
/// assemblies.
inline constexpr double kDefaultAngularDeflection = 0.3490658503988659;

/// Options of every reader.
struct ImportOptions {
  std::string units;  ///< "mm", "cm", "m", "um", "in", "ft": overrides what the file says; empty: as the file says, mm
                      ///< where it does not.
  double deflection = 0;  ///< CAD files: largest distance of a triangle from its surface [mm]; 0:
                          ///< kDefaultRelativeDeflection of the assembly's size.
  double angular_deflection =
      0;  ///< CAD files: largest turn of the normal from facet to facet [rad]; 0: kDefaultAngularDeflection.
  Solids solids = Solids::Split;  ///< CAD files: products with several solids; URDF: links with several visuals.
  bool drop_duplicates = false;   ///< Leaves out components that find_duplicates() finds.
  ImportLimits limits;            ///< Refuses larger input.
  /// Folders besides the file's own in which the files that it refers to may be.
  std::vector<std::filesystem::path> reference_folders;
  /// CAD, COLLADA and URDF files: keeps the triangles of the files that were read (kCacheBytes of them), for the next
  /// time that a file is read with the same options; empty: keeps nothing.
  std::filesystem::path cache_folder;
  ProgressCallback progress;  ///< May be empty; may cancel.
};

}  // namespace dismantle
