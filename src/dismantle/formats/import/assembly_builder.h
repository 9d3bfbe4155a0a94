// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"
#include "dismantle/formats/import/mesh_source.h"

#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The largest coordinate that a reader accepts [mm], a thousand kilometres; products of four coordinates cannot
/// overflow.
constexpr double kLargestCoordinate = 1e9;

/// Checks that no coordinate, in a component's own frame or assembled, is larger than kLargestCoordinate. Errors:
/// Unreadable.
Result<Done> check_coordinates(const Assembly& assembly);

/// Builds an Assembly from the parts that a mesh reader finds, in their order: scales them to millimetres, cleans them,
/// enforces the limits, makes names unique, and builds a tree of one level, or two where components are in groups.
class AssemblyBuilder {
 public:
  /// `source_name` is the file's name without its folder (the tree's root); `file_units` the unit of its numbers,
  /// unless the options override it. Errors: Usage for unknown units.
  static Result<AssemblyBuilder> create(std::string source_name, std::string_view file_units,
                                        const ImportOptions& options);

  /// Appends a component placed at `assembly_from_part` (in the file's units), below the node `group` of the tree if it
  /// is not empty: components of one group are added one after another. A part without triangles after cleaning is
  /// dropped. Returns an Error if a limit is exceeded or a coordinate is larger than kLargestCoordinate.
  std::optional<Error> add(MeshPart part, const RigidTransform& assembly_from_part = {}, const std::string& group = {});

  /// Millimetres per unit of the file.
  double scale() const { return scale_; }

  /// The assembly. Errors: Unreadable if it has no component.
  Result<Assembly> finish(std::string sha256);

 private:
  AssemblyBuilder() = default;

  const ImportOptions* options_ = nullptr;
  Assembly assembly_;
  std::vector<std::string> groups_;  // by component; empty: none
  double scale_ = 1;
  std::size_t triangles_ = 0;
};

}  // namespace dismantle
