// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/assembly_builder.h"

#include "dismantle/formats/import/units.h"

#include <memory>
#include <utility>

namespace dismantle {

namespace {

Error beyond(const std::string& source, const std::string& what) {
  return {ErrorKind::Unreadable, source + " is too large (" + what + "); simplify it or load a part of it"};
}

bool within_reach(Vec3 p) {
  return is_finite(p) && max_abs(p) <= kLargestCoordinate;
}

Error out_of_reach(const std::string& source, std::string_view component) {
  return {ErrorKind::Unreadable, source + " cannot be used (a coordinate of " + in_quotes(component) +
                                     " is further out than a thousand kilometres); check the units"};
}

}  // namespace

Result<Done> check_coordinates(const Assembly& assembly) {
  for (const Component& component : assembly.components)
    for (const Vec3& p : component.mesh->vertices)
      if (!within_reach(p) || !within_reach(component.assembly_from_mesh * p))
        return out_of_reach(assembly.source_file, component.name);
  return Done{};
}

Result<AssemblyBuilder> AssemblyBuilder::create(std::string source_name, std::string_view file_units,
                                                const ImportOptions& options) {
  AssemblyBuilder builder;
  builder.options_ = &options;
  builder.assembly_.source_file = source_name;
  builder.assembly_.source_units = options.units.empty() ? file_units : options.units;
  builder.assembly_.tree.push_back({std::move(source_name), 0});
  const Result<double> scale = millimetres_per_unit(builder.assembly_.source_units);
  if (!scale) return scale.error();
  builder.scale_ = *scale;
  return builder;
}

std::optional<Error> AssemblyBuilder::add(MeshPart part, const RigidTransform& assembly_from_part,
                                          const std::string& group) {
  if (part.mesh.faces.empty()) return std::nullopt;
  const std::string& source = assembly_.source_file;
  triangles_ += part.mesh.faces.size();
  if (triangles_ > options_->limits.triangles)
    return beyond(source, "more than " + std::to_string(options_->limits.triangles) + " triangles");
  if (assembly_.components.size() == options_->limits.components)
    return beyond(source, "more than " + std::to_string(options_->limits.components) + " components");

  Component component;
  component.assembly_from_mesh = assembly_from_part;
  component.assembly_from_mesh.translation *= scale_;
  for (Vec3& p : part.mesh.vertices) {
    p *= scale_;
    if (!within_reach(p) || !within_reach(component.assembly_from_mesh * p)) return out_of_reach(source, part.name);
  }

  CleanedMesh cleaned = clean_mesh(part.mesh);
  if (cleaned.mesh.faces.empty()) return std::nullopt;
  component.name = std::move(part.name);
  component.mesh = std::make_shared<const TriangleMesh>(std::move(cleaned.mesh));
  component.faults = cleaned.faults;
  component.color = part.color;
  assembly_.components.push_back(std::move(component));
  groups_.push_back(group);
  return std::nullopt;
}

Result<Assembly> AssemblyBuilder::finish(std::string sha256) {
  if (assembly_.components.empty())
    return Error{ErrorKind::Unreadable,
                 assembly_.source_file + " holds no component (no triangle with an area); export it again as meshes"};
  make_names_unique(assembly_.components);
  std::uint32_t parent = 0;
  for (std::size_t i = 0; i < assembly_.components.size(); ++i) {
    if (groups_[i] != (i == 0 ? std::string() : groups_[i - 1])) {
      parent = groups_[i].empty() ? 0 : static_cast<std::uint32_t>(assembly_.tree.size());
      if (parent != 0) assembly_.tree.push_back({groups_[i], 0});
    }
    assembly_.components[i].tree_node = static_cast<std::uint32_t>(assembly_.tree.size());
    assembly_.tree.push_back({assembly_.components[i].name, parent});
  }
  assembly_.source_sha256 = std::move(sha256);
  return std::move(assembly_);
}

}  // namespace dismantle
