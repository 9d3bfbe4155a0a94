// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/cad_assembly.h"

#include "dismantle/formats/cad/mesh_shapes.h"
#include "dismantle/formats/cad/read_cad.h"
#include "dismantle/formats/cad/shape_mesh.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/units.h"

#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace dismantle {

namespace {

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

double assembly_diagonal(const CadProductTree& products) {
  Bnd_Box box;
  std::vector<Bnd_Box> shape_boxes(products.shapes.size());
  for (std::size_t i = 0; i < products.shapes.size(); ++i) BRepBndLib::Add(products.shapes[i], shape_boxes[i], false);
  for (const CadOccurrence& o : products.occurrences)
    if (!shape_boxes[o.shape].IsVoid()) box.Add(shape_boxes[o.shape].Transformed(o.placement));
  return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

/// The colour of the largest part of the shape's surface: a face's own, else its solid's, else the product's; none if
/// none is set.
std::optional<Color> surface_color(const TopoDS_Shape& shape, const CadProduct& product) {
  const Color* whole = product.subshape_colors.Seek(shape);
  const std::optional<Color> base = whole ? std::optional(*whole) : product.color;
  if (product.subshape_colors.IsEmpty()) return base;

  std::vector<std::pair<std::optional<Color>, double>> areas;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Shape face = faces.Current().Located(TopLoc_Location());
    const Color* own = product.subshape_colors.Seek(face);
    const std::optional<Color> color = own ? std::optional(*own) : base;
    auto place = std::find_if(areas.begin(), areas.end(), [&](const auto& a) { return a.first == color; });
    if (place == areas.end()) place = areas.insert(place, {color, 0.0});
    place->second += triangulated_area(face);
  }
  const auto largest =
      std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest == areas.end() ? base : largest->first;
}

Vec3 vec3(const gp_XYZ& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// The rigid part of a placement; the scale (negative: mirrored through the origin) goes into the mesh.
RigidTransform rigid_part(const gp_Trsf& placement, double millimetres) {
  const gp_Mat& m = placement.HVectorialPart();
  return {{{vec3(m.Row(1)), vec3(m.Row(2)), vec3(m.Row(3))}}, millimetres * vec3(placement.TranslationPart())};
}

/// Meshes in the component's frame, one for each shape and scale, shared.
class ComponentMeshes {
 public:
  struct Entry {
    std::shared_ptr<const TriangleMesh> mesh;
    MeshFaults faults;
    double largest_coordinate = 0;
  };

  explicit ComponentMeshes(const std::vector<TopoDS_Shape>& shapes) : shapes_(shapes) {}

  const Entry& get(std::uint32_t shape, double scale) {
    const auto [place, is_new] = entries_.try_emplace({shape, scale});
    if (!is_new) return place->second;
    TriangleMesh mesh = mesh_from_shape(shapes_[shape]);
    if (scale != 1)
      for (Vec3& p : mesh.vertices) p *= scale;
    if (scale < 0)
      for (Face& f : mesh.faces) std::swap(f.v[1], f.v[2]);
    CleanedMesh cleaned = clean_mesh(mesh);
    for (const Vec3& p : cleaned.mesh.vertices)
      place->second.largest_coordinate = is_finite(p) ? std::max(place->second.largest_coordinate, max_abs(p))
                                                      : std::numeric_limits<double>::infinity();
    place->second.mesh = std::make_shared<const TriangleMesh>(std::move(cleaned.mesh));
    place->second.faults = cleaned.faults;
    return place->second;
  }

 private:
  const std::vector<TopoDS_Shape>& shapes_;
  std::map<std::pair<std::uint32_t, double>, Entry> entries_;
};

/// A scale within rounding of 1 (from concatenated placements) is 1.
double tidy_scale(double scale) {
  return std::abs(std::abs(scale) - 1) < 1e-12 ? (scale < 0 ? -1.0 : 1.0) : scale;
}

/// Components from meshed shapes. `unit_scale`: mm in the assembly per mm of the shapes.
Result<Assembly> build_assembly(CadProductTree products, double unit_scale, const ImportOptions& options) {
  Assembly assembly;
  assembly.tree = std::move(products.tree);
  ComponentMeshes meshes(products.shapes);
  std::size_t triangles = 0;
  for (CadOccurrence& o : products.occurrences) {
    const double scale = tidy_scale(o.placement.ScaleFactor());
    const ComponentMeshes::Entry& entry = meshes.get(o.shape, scale * unit_scale);
    triangles += entry.mesh->faces.size();
    if (triangles > options.limits.triangles)
      return unreadable("it has more than " + std::to_string(options.limits.triangles) +
                        " triangles; mesh it with a larger deflection");
    if (entry.mesh->faces.empty()) continue;
    const RigidTransform placement = rigid_part(o.placement, unit_scale);
    if (!(entry.largest_coordinate + max_abs(placement.translation) <= kLargestCoordinate))
      return unreadable("\"" + o.name + "\" reaches further than a thousand kilometres; check its units");

    Component c;
    c.name = std::move(o.name);
    c.mesh = entry.mesh;
    c.faults = entry.faults;
    c.assembly_from_mesh = placement;
    c.tree_node = o.tree_node;
    const std::optional<Color> own = surface_color(products.shapes[o.shape], products.products[o.product]);
    c.color = o.instance_color.value_or(own.value_or(o.inherited_color.value_or(Color{})));
    assembly.components.push_back(std::move(c));
    assembly.deflection = std::max(assembly.deflection, std::abs(scale));
  }
  make_names_unique(assembly.components);
  return assembly;
}

}  // namespace

Result<Assembly> assembly_from_cad(CadModel model, const ImportOptions& options) {
  const double unit_scale = options.units.empty() ? 1 : *millimetres_per_unit(options.units) / model.unit.millimetres;
  const double diagonal = assembly_diagonal(model.products);
  const double deflection =
      options.deflection > 0 ? options.deflection / unit_scale : std::max(kDefaultRelativeDeflection * diagonal, 1e-6);
  const double angle = options.angular_deflection > 0 ? options.angular_deflection : kDefaultAngularDeflection;
  mesh_shapes(model.products.shapes, deflection, angle, options.progress);

  report_progress(options.progress, "building", 0);
  Result<Assembly> assembly = build_assembly(std::move(model.products), unit_scale, options);
  if (!assembly) return assembly;
  if (assembly->components.empty()) return unreadable("it holds no solid and no surface; export the solids with it");
  assembly->deflection *= deflection * unit_scale;
  assembly->source_units = options.units.empty() ? model.unit.name : options.units;
  return assembly;
}

}  // namespace dismantle
