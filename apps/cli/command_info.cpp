// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/commands.h"
#include "dismantle/assembly/duplicates.h"
#include "dismantle/documents/fastener_json.h"
#include "dismantle/fasteners/find_fasteners.h"
#include "dismantle/files/number_text.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/surface/equal_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

namespace dismantle::cli {

namespace {

using Json = nlohmann::ordered_json;

std::string describe_faults(const MeshFaults& f) {
  std::string text;
  const auto add = [&text](std::size_t count, const char* what, const char* then = "") {
    if (count > 0) text += (text.empty() ? "" : ", ") + count_text(count, what) + then;
  };
  add(f.degenerate_faces, "degenerate triangle", " dropped");
  add(f.boundary_edges, "boundary edge");
  add(f.nonmanifold_edges, "non-manifold edge");
  add(f.misoriented_edges, "misoriented edge");
  if (!text.empty() && !f.closed() && f.open_edges == 0) text += ": cracks of zero width";
  if (f.inside_out) text += fmt::format("{}inside out", text.empty() ? "" : ", ");
  return text.empty() ? "closed" : text;
}

Json to_json(Vec3 p) {
  return Json::array({p.x, p.y, p.z});
}

/// The components that another one is a duplicate of, by component; invalid for all others.
std::vector<ComponentId> originals(const Assembly& assembly) {
  std::vector<ComponentId> found(assembly.components.size());
  for (const Duplicate& d : find_duplicates(assembly)) found[d.component.value] = d.of;
  return found;
}

/// The products that are several components each, one a solid: nodes all of whose children are components of its name.
struct SplitProducts {
  std::size_t products = 0, components = 0;
};

SplitProducts split_products(const Assembly& assembly) {
  std::vector<std::size_t> components(assembly.tree.size()), nodes(assembly.tree.size());
  std::vector<bool> is_component(assembly.tree.size());
  for (const Component& c : assembly.components) is_component[c.tree_node] = true;
  for (std::uint32_t node = 1; node < assembly.tree.size(); ++node) {
    const std::uint32_t parent = assembly.tree[node].parent;
    ++nodes[parent];
    if (is_component[node] && assembly.tree[node].name == assembly.tree[parent].name) ++components[parent];
  }
  SplitProducts split;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (components[node] > 1 && components[node] == nodes[node]) {
      ++split.products;
      split.components += components[node];
    }
  return split;
}

/// The links of a URDF that are several components each: the groups below the root.
SplitProducts split_links(const Assembly& assembly) {
  SplitProducts split;
  std::uint32_t last = 0;
  for (const Component& c : assembly.components) {  // those of a link are one after another
    const std::uint32_t link = assembly.tree[c.tree_node].parent;
    if (link == 0) continue;
    ++split.components;
    if (link != last) ++split.products;
    last = link;
  }
  return split;
}

void print_split(const Assembly& assembly) {
  const FormatEntry* format = format_of(assembly.source_file);
  const bool is_urdf = format != nullptr && format->format == FileFormat::Urdf;
  const SplitProducts split = is_urdf ? split_links(assembly) : split_products(assembly);
  if (split.products == 0) return;
  const std::string whole = is_urdf ? "link" : "product", piece = is_urdf ? "visual" : "solid";
  fmt::print("{} with several {}s: {} components, one for each {} (--solids join: one for each {})\n",
             count_text(split.products, whole), piece, split.components, piece, whole);
}

Json fasteners_json(const Assembly& a, const Executor& executor) {
  Json list = Json::array();
  for (const CountedFastener& counted : counted_fasteners(find_fasteners(a, executor))) {
    Json entry = fastener_json(counted.fastener), names = Json::array();
    for (const ComponentId c : counted.components) names.push_back(a[c].name);
    entry["count"] = counted.components.size();
    entry["components"] = names;
    list.push_back(entry);
  }
  return list;
}

void print_fasteners(const Assembly& a, const Executor& executor) {
  const std::vector<CountedFastener> list = counted_fasteners(find_fasteners(a, executor));
  if (list.empty()) return;
  std::size_t width = 0;  // of names that a tool follows
  for (const CountedFastener& f : list)
    if (!tool_text(f.fastener).empty()) width = std::max(width, fastener_text(f.fastener).size());
  fmt::print("\nfasteners\n");
  for (const CountedFastener& f : list) {
    const std::string name = fastener_text(f.fastener), tool = tool_text(f.fastener);
    if (tool.empty())
      fmt::print("{:>4}  {}\n", f.components.size(), name);
    else
      fmt::print("{:>4}  {:<{}}  {}\n", f.components.size(), name, width, tool);
  }
}

Json to_json(const Assembly& a, const Executor& executor) {
  const Aabb box = assembled_bounds(a);
  const std::vector<ComponentId> duplicate_of = originals(a), shapes = first_of_shape(a);
  Json components = Json::array();
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    const Component& c = a.components[i];
    const Aabb b = assembled_bounds(c);
    const MeshFaults& f = c.faults;
    components.push_back({{"name", c.name},
                          {"triangles", c.mesh->faces.size()},
                          {"vertices", c.mesh->vertices.size()},
                          {"bounds", {to_json(b.lower), to_json(b.upper)}},
                          {"closed", f.closed()},
                          {"degenerate_triangles", f.degenerate_faces},
                          {"boundary_edges", f.boundary_edges},
                          {"nonmanifold_edges", f.nonmanifold_edges},
                          {"misoriented_edges", f.misoriented_edges},
                          {"open_edges", f.open_edges},
                          {"inside_out", f.inside_out},
                          {"same_shape_as", shapes[i].value != i ? Json(a[shapes[i]].name) : Json(nullptr)},
                          {"duplicate_of", duplicate_of[i].valid() ? Json(a[duplicate_of[i]].name) : Json(nullptr)}});
  }
  return {{"format", "dismantle-info"},
          {"version", 1},
          {"assembly",
           {{"file", a.source_file},
            {"sha256", a.source_sha256},
            {"units", a.source_units},
            {"components", a.components.size()},
            {"shapes", shape_count(shapes)},
            {"triangles", triangle_count(a)},
            {"bounds", {to_json(box.lower), to_json(box.upper)}},
            {"deflection_mm", a.deflection},
            {"deflection_is_estimated", a.deflection_is_estimated},
            {"simplification_error_mm", a.simplification_error},
            {"default_tolerance_mm", default_tolerance(a)}}},
          {"fasteners", fasteners_json(a, executor)},
          {"components", components}};
}

void print_text(const Assembly& a, const Executor& executor) {
  const Aabb box = assembled_bounds(a);
  const Vec3 size = box.size();
  const std::vector<ComponentId> shapes = first_of_shape(a);
  fmt::print("{}: {} of {}, {}\n", a.source_file, count_text(a.components.size(), "component"),
             count_text(shape_count(shapes), "different shape"), count_text(triangle_count(a), "triangle"));
  const auto length = [](double mm) { return number_text(mm, 6); };
  fmt::print("units {}, size {} x {} x {} mm, default tolerance {} mm\n", a.source_units, length(size.x),
             length(size.y), length(size.z), number_text(default_tolerance(a), 4));
  if (a.deflection > 0)
    fmt::print("tessellation deflection {} mm{}\n", number_text(a.deflection, 4),
               a.deflection_is_estimated ? " (estimated from the facets)" : "");
  if (a.simplification_error > 0)
    fmt::print("simplification moved the surface by at most {} mm\n", number_text(a.simplification_error, 4));
  print_split(a);
  const std::vector<ComponentId> duplicate_of = originals(a);
  std::size_t width = 9;
  for (const Component& c : a.components) width = std::max(width, c.name.size());
  fmt::print("\n{:<{}}  {:>9}  {}\n", "component", width, "triangles", "mesh");
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    const Component& c = a.components[i];
    fmt::print("{:<{}}  {:>9}  {}\n", c.name, width, c.mesh->faces.size(), describe_faults(c.faults));
    if (duplicate_of[i].valid())
      fmt::print("{:<{}}  identical and coincident with {}; probably placed twice (--drop-duplicates leaves it out)\n",
                 "", width, a[duplicate_of[i]].name);
  }
  print_fasteners(a, executor);
}

}  // namespace

void add_info_command(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("info", "Components, triangles, units and mesh faults of an assembly");
  auto options = std::make_shared<CommonOptions>();
  add_assembly_argument(*command, *options);
  add_common_options(*command, *options);
  command->callback([options, &exit_code] {
    const Result<Assembly> assembly = load(*options);
    if (!assembly) {
      exit_code = report(assembly.error());
    } else if (options->json) {
      fmt::print("{}\n",
                 to_json(*assembly, make_executor(*options)).dump(2, ' ', false, Json::error_handler_t::replace));
    } else {
      print_text(*assembly, make_executor(*options));
    }
  });
}

}  // namespace dismantle::cli
