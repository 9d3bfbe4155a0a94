// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/check_report.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/files/user_folders.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/surface/find_clashes.h"
#include "python/src/bind.h"

#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace dismantle::python {

namespace {

using Faces = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

/// One component, kept alive with its assembly.
struct ComponentView {
  std::shared_ptr<const Assembly> assembly;
  ComponentId id;
  const Component& get() const { return (*assembly)[id]; }
};

std::shared_ptr<Assembly> load(const std::filesystem::path& file, const std::string& units, double deflection,
                               double angular_deflection, const std::string& solids, bool drop_duplicates, bool cache,
                               const std::vector<std::string>& references, double import_memory, double import_time,
                               const py::object& progress) {
  PythonProgress watched(progress);
  ImportOptions options;
  options.units = units;
  options.deflection = deflection;
  options.angular_deflection = angular_deflection;
  if (solids != "split" && solids != "join")
    raise_usage("solids '" + solids +
                "' is unknown (a product with several solids is split or joined); give 'split' or "
                "'join'");
  options.solids = solids == "join" ? Solids::Join : Solids::Split;
  options.drop_duplicates = drop_duplicates;
  options.reference_folders.assign(references.begin(), references.end());
  if (!(import_memory >= 0) || !(import_time >= 0))
    raise_usage("the limits of reading make no sense (one is negative); give 0 for the default");
  options.limits.memory_bytes = static_cast<std::uint64_t>(import_memory * (1 << 20));
  options.limits.cpu_seconds = import_time;
  if (cache) options.cache_folder = user_cache_folder().value_or(std::filesystem::path());
  options.progress = watched.callback();
  Result<Assembly> assembly = without_gil([&] { return load_assembly(file, options); });
  watched.finish();
  return std::make_shared<Assembly>(value_or_raise(std::move(assembly)));
}

TriangleMesh mesh_of(const std::string& name, const DoubleArray& vertices, const Faces& faces) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3 || faces.ndim() != 2 || faces.shape(1) != 3)
    raise_usage("the mesh of '" + name + "' cannot be read (its arrays have another shape); give (n, 3) and (m, 3)");
  TriangleMesh mesh;
  const auto* points = reinterpret_cast<const Vec3*>(vertices.data());
  const auto* triangles = reinterpret_cast<const Face*>(faces.data());
  mesh.vertices.assign(points, points + vertices.shape(0));
  mesh.faces.assign(triangles, triangles + faces.shape(0));
  for (const Vec3& p : mesh.vertices)
    if (!is_finite(p)) raise_usage("the mesh of '" + name + "' cannot be read (a vertex is not finite); correct it");
  for (const Face& f : mesh.faces)
    for (const std::uint32_t v : f.v)
      if (v >= mesh.vertices.size())
        raise_usage("the mesh of '" + name + "' cannot be read (a face has an index without a vertex); correct it");
  return mesh;
}

std::shared_ptr<Assembly> from_meshes(const py::dict& meshes, const std::string& units) {
  ImportOptions options;
  options.units = units;
  AssemblyBuilder builder = value_or_raise(AssemblyBuilder::create("meshes", "mm", options));
  for (const auto& [key, value] : meshes) {
    const auto name = key.cast<std::string>();
    const auto arrays = value.cast<std::pair<DoubleArray, Faces>>();
    if (const auto error = builder.add({name, mesh_of(name, arrays.first, arrays.second), {}, {}})) raise(*error);
  }
  return std::make_shared<Assembly>(value_or_raise(builder.finish({})));
}

CheckedHolder check(const std::shared_ptr<Assembly>& assembly, double tolerance, double clearance,
                    const std::string& pairs, const std::vector<std::tuple<std::string, std::string, double>>& allow,
                    int threads, const py::object& progress) {
  if (!(tolerance >= 0) || !(clearance >= 0))
    raise_usage("the pairs cannot be checked (a length is negative); give 0 for the default");
  if (pairs != "auto" && pairs != "paper")
    raise_usage("there is no rule '" + pairs + "' (pairs are 'auto' or 'paper'); give one of these");
  PythonProgress watched(progress);
  const ClashOptions options{tolerance, clearance, true, executor_of(threads), watched.callback()};
  Result<Clashes> clashes = without_gil([&] { return find_clashes(*assembly, options); });
  watched.finish();
  Clashes found = value_or_raise(std::move(clashes));
  PairStates states = pair_states(found, pairs == "auto" ? ClassifyRule::Auto : ClassifyRule::Paper);
  std::vector<DeclaredAllowance> declared;
  for (const auto& [a, b, depth] : allow) {
    if (!(depth > 0)) raise_usage("no overlap can be allowed (its depth is not above 0); give a depth in mm");
    declared.push_back({a, b, depth});
  }
  value_or_raise(declare_allowances(states, *assembly, declared));
  return std::make_shared<CheckedAssembly>(CheckedAssembly{assembly, std::move(states), std::move(found)});
}

py::array_t<double> transform_array(const RigidTransform& t) {
  py::array_t<double> array({4, 4});
  auto rows = array.mutable_unchecked<2>();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      rows(r, c) = r == 3 ? (c == 3 ? 1 : 0) : (c == 3 ? t.translation[r] : t.rotation.row[r][c]);
  return array;
}

void bind_component(py::module_& module) {
  using Mesh = std::shared_ptr<const TriangleMesh>;
  const auto owner = [](const Mesh& mesh) {
    return py::capsule(new Mesh(mesh), [](void* p) { delete static_cast<Mesh*>(p); });
  };
  py::class_<ComponentView>(module, "Component", "A rigid component of an assembly.")
      .def_property_readonly(
          "name", [](const ComponentView& c) { return c.get().name; }, "Unique in the assembly.")
      .def_property_readonly(
          "index", [](const ComponentView& c) { return c.id.value; }, "Index in Assembly.components.")
      .def_property_readonly(
          "vertices",
          [owner](const ComponentView& c) {
            const Mesh& mesh = c.get().mesh;
            return array_view<double, Vec3>(reinterpret_cast<const double*>(mesh->vertices.data()),
                                            mesh->vertices.size(), owner(mesh), 3);
          },
          "Vertices of the mesh [mm, component frame], shape (n, 3), float64. A read-only view, not a copy.")
      .def_property_readonly(
          "faces",
          [owner](const ComponentView& c) {
            const Mesh& mesh = c.get().mesh;
            return array_view<std::uint32_t, Face>(reinterpret_cast<const std::uint32_t*>(mesh->faces.data()),
                                                   mesh->faces.size(), owner(mesh), 3);
          },
          "Triangles as vertex indices, shape (m, 3), uint32. A read-only view, not a copy.")
      .def_property_readonly(
          "transform", [](const ComponentView& c) { return transform_array(c.get().assembly_from_mesh); },
          "Homogeneous transform from the component frame to the assembly frame [mm], shape (4, 4).")
      .def_property_readonly(
          "assembled_vertices",
          [](const ComponentView& c) {
            auto [kept, first] = make_owner(assembled_vertices(c.get()));
            return array_view<double, Vec3>(&first->x, c.get().mesh->vertices.size(), kept, 3);
          },
          "Vertices in the assembled state [mm, assembly frame], shape (n, 3).")
      .def_property_readonly(
          "color",
          [](const ComponentView& c) {
            const Color& color = c.get().color;
            return std::array<float, 4>{color.r, color.g, color.b, color.a};
          },
          "Red, green, blue, alpha, each from 0 to 1.")
      .def_property_readonly(
          "is_closed", [](const ComponentView& c) { return c.get().faults.closed(); },
          "True if the mesh bounds a volume.")
      .def("__repr__", [](const ComponentView& c) {
        return "<dismantle.Component '" + c.get().name + "', " + std::to_string(c.get().mesh->faces.size()) +
               " triangles>";
      });
}

void bind_assembly_class(py::module_& module) {
  using Holder = std::shared_ptr<Assembly>;
  py::class_<Assembly, Holder>(
      module, "Assembly",
      "A list of components in the assembled state. `assembly[key]` is the component with a name or an index.")
      .def_static("from_meshes", &from_meshes, py::arg("meshes"), py::kw_only(), py::arg("units") = "mm",
                  "Makes an assembly from meshes {name: (vertices, faces)}, of shapes (n, 3) and (m, 3), in assembled "
                  "position. "
                  "`units`: unit of the vertices (mm, cm, m, um, in, ft).")
      .def_property_readonly(
          "names",
          [](const Assembly& a) {
            std::vector<std::string> names;
            for (const Component& c : a.components) names.push_back(c.name);
            return names;
          },
          "Names of the components, by index.")
      .def_property_readonly(
          "components",
          [](const Holder& a) {
            std::vector<ComponentView> views;
            for (std::uint32_t i = 0; i < a->components.size(); ++i) views.push_back({a, ComponentId(i)});
            return views;
          },
          "The components, by index.")
      .def_property_readonly("triangle_count", &triangle_count, "Number of triangles of all components.")
      .def_property_readonly("default_tolerance", &default_tolerance, "Tolerance that check() uses by default [mm].")
      .def_property_readonly(
          "bounds",
          [](const Assembly& a) {
            const Aabb box = assembled_bounds(a);
            return py::make_tuple(to_array(box.lower), to_array(box.upper));
          },
          "Lower and upper corner of the bounding box in the assembled state [mm], each of shape (3,).")
      .def_readonly("source_file", &Assembly::source_file, "Name of the file that it was read from.")
      .def("__len__", [](const Assembly& a) { return a.components.size(); })
      .def(
          "__getitem__",
          [](const Holder& a, const py::object& key) {
            return ComponentView{a, component_of(*a, key)};
          },
          py::arg("key"))
      .def("__repr__", [](const Assembly& a) {
        return "<dismantle.Assembly '" + a.source_file + "', " + std::to_string(a.components.size()) + " components>";
      });
}

/// A pair with its names.
struct PairView {
  Clash clash;
  std::string a, b;
};

void bind_pairs(py::module_& module) {
  py::class_<PairView>(module, "Pair", "State of a pair of components in the assembled state.")
      .def_readonly("a", &PairView::a, "Name of the first component.")
      .def_readonly("b", &PairView::b, "Name of the second component.")
      .def_property_readonly(
          "state", [](const PairView& p) { return std::string(name_of(p.clash.state)); },
          "'near', 'contact' or 'overlapping'.")
      .def_property_readonly(
          "contained", [](const PairView& p) { return p.clash.contained.valid(); },
          "True if one component lies wholly inside the other one.")
      .def_property_readonly(
          "distance", [](const PairView& p) { return p.clash.distance; }, "Distance where they are apart, else 0 [mm].")
      .def_property_readonly(
          "depth", [](const PairView& p) { return p.clash.depth; },
          "Depth of the pair [mm]: the greatest distance from a point of either surface inside the other component to "
          "that component's surface; an upper bound, at most 1% or a tenth of the tolerance above it.")
      .def_property_readonly(
          "deepest_at",
          [](const PairView& p) {
            const Vec3 at = p.clash.deepest_at;
            return std::make_tuple(at.x, at.y, at.z);
          },
          "The deepest point, or else one where they are nearest [mm, assembly frame].")
      .def_property_readonly(
          "volume", [](const PairView& p) { return p.clash.volume; },
          "Volume in common of components that overlap, estimated to about 1% [mm^3].")
      .def("__repr__", [](const PairView& p) {
        return "<dismantle.Pair '" + p.a + "', '" + p.b + "': " + std::string(name_of(p.clash.state)) + ">";
      });
  py::class_<CheckedAssembly, CheckedHolder>(module, "PairStates",
                                             "The states of all pairs of components that are near, touch or overlap. "
                                             "Needed by everything that moves components.")
      .def_property_readonly(
          "tolerance", [](const CheckedAssembly& c) { return c.pairs.tolerance; },
          "Depth that counts as touching [mm].")
      .def_property_readonly(
          "assembly", [](const CheckedAssembly& c) { return c.assembly; }, "The assembly.")
      .def_property_readonly(
          "pairs",
          [](const CheckedAssembly& c) {
            std::vector<PairView> views;
            for (const Clash& p : c.clashes.pairs)
              views.push_back({p, (*c.assembly)[p.a].name, (*c.assembly)[p.b].name});
            return views;
          },
          "The pairs.")
      .def(
          "report", [](const CheckedAssembly& c) { return check_report_text(*c.assembly, c.clashes); },
          "The report as text, as printed by 'dismantle check'.")
      .def(
          "report_json", [](const CheckedAssembly& c) { return check_report_json(*c.assembly, c.clashes); },
          "The report as JSON, as printed by 'dismantle check --json'.")
      .def("__len__", [](const CheckedAssembly& c) { return c.clashes.pairs.size(); });
}

}  // namespace

void bind_assembly(py::module_& module) {
  bind_component(module);
  bind_assembly_class(module);
  bind_pairs(module);
  module.def(
      "load", &load, py::arg("file"), py::kw_only(), py::arg("units") = "", py::arg("deflection") = 0.0,
      py::arg("angular_deflection") = 0.0, py::arg("solids") = "split", py::arg("drop_duplicates") = false,
      py::arg("cache") = true, py::arg("references") = std::vector<std::string>(), py::arg("import_memory") = 0.0,
      py::arg("import_time") = 0.0, py::arg("progress") = py::none(),
      ("Reads a file (" + format_names() +
       "), or a folder of meshes. `units`: unit of the coordinates (mm, cm, "
       "m, um, in, ft; default: by the format). CAD files: `deflection` [mm] and `angular_deflection` [rad] of the "
       "tessellation; 0: default. `solids`: what a product with several solids, or a URDF link with several visuals, "
       "gives, a component of each (split) or one of all (join). `drop_duplicates`: leaves out components that are "
       "identical with another one and in the same place. `cache`: keeps the triangles of CAD, COLLADA and URDF files "
       "for the next time. `references`: folders besides the file's own in which the files that it refers to may be. "
       "`import_memory` [MiB], `import_time` [s]: what reading may take; 0: by the size of the file.")
          .c_str());
  module.def(
      "check", &check, py::arg("assembly"), py::kw_only(), py::arg("tolerance") = 0.0, py::arg("clearance") = 0.0,
      py::arg("pairs") = "auto", py::arg("allow") = py::list(), py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "Finds all pairs of components that touch, overlap or are near in the assembled state, and how deep each may get "
      "in motion. `tolerance` [mm]; 0: default. Pairs within `clearance` [mm] are reported as near. `pairs`: "
      "the rule, 'auto' or 'paper'. `allow`: list of (name, name, depth [mm]), components that touch or overlap and "
      "may get that deep in each other until they have been apart.");
}

}  // namespace dismantle::python
