// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/read_urdf.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/mesh/tessellate.h"
#include "dismantle/formats/urdf/urdf_kinematics.h"
#include "dismantle/formats/urdf/urdf_meshes.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace dismantle {

using tinyxml2::XMLElement;

namespace {

/// Largest URDF text [bytes]; meshes are separate files.
constexpr std::size_t kLargestUrdf = std::size_t{64} << 20;

std::string attribute(const XMLElement& element, const char* name) {
  const char* const text = element.Attribute(name);
  return text == nullptr ? "" : text;
}

/// The numbers of an attribute like "0 0 1.5", or none if they are not exactly that many finite numbers.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers(std::string_view text) {
  std::array<double, kCount> values{};
  for (double& value : values) {
    const std::optional<double> number = to_double(take_word(text));
    if (!number) return std::nullopt;
    value = *number;
  }
  return take_word(text).empty() ? std::optional(values) : std::nullopt;
}

double area(const TriangleMesh& mesh) {
  double twice = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) twice += length(normal_unscaled(mesh.triangle(f)));
  return twice / 2;
}

/// All parts as one, with the colour of the one that has the largest surface.
MeshPart joined(const std::vector<MeshPart>& parts) {
  MeshPart whole;
  double largest = -1;
  for (const MeshPart& part : parts) {
    const auto first = static_cast<std::uint32_t>(whole.mesh.vertices.size());
    whole.mesh.vertices.insert(whole.mesh.vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
    for (const Face& f : part.mesh.faces)
      whole.mesh.faces.push_back({{first + f.v[0], first + f.v[1], first + f.v[2]}});
    const double size = area(part.mesh);
    if (size > largest) whole.color = part.color;
    largest = std::max(largest, size);
  }
  return whole;
}

/// A visual of a link: its mesh in its own frame [m], with its name, which may be empty, and its colour.
struct Visual {
  MeshPart part;
  RigidTransform link_from_visual;  // [m]
};

/// Reads one URDF document.
class UrdfParser {
 public:
  UrdfParser(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh)
      : source_(source), options_(options), load_mesh_(load_mesh) {}

  Result<Assembly> parse();

 private:
  Error wrong(const std::string& why) const { return malformed(source_, "URDF", why); }
  Result<Vec3> vector(const XMLElement& element, const char* name, Vec3 otherwise) const;
  Result<RigidTransform> origin(const XMLElement& element) const;
  void read_materials(const XMLElement& robot);
  std::optional<Color> color(const XMLElement& visual) const;
  std::optional<Error> read_joints(const XMLElement& robot);
  std::optional<Error> add_link(const XMLElement& link, const RigidTransform& frame, AssemblyBuilder& builder);
  Result<std::vector<Visual>> visuals(const XMLElement& link);
  Result<MeshPart> geometry(const XMLElement& visual);
  Result<MeshPart> mesh_file(const XMLElement& mesh);
  Result<TriangleMesh> primitive(const XMLElement& shape);

  const MeshSource& source_;
  const ImportOptions& options_;
  const MeshLoader& load_mesh_;
  std::unordered_map<std::string, Color> materials_;
  std::vector<UrdfJoint> joints_;
  std::size_t triangles_ = 0;
  double deflection_ = 0;  // [m]
};

Result<Assembly> UrdfParser::parse() {
  tinyxml2::XMLDocument document;
  if (document.Parse(source_.bytes.data(), source_.bytes.size()) != tinyxml2::XML_SUCCESS)
    return wrong("line " + std::to_string(document.ErrorLineNum()) + ": no well-formed XML");
  const XMLElement* const robot = document.RootElement();
  if (robot == nullptr || std::string_view(robot->Name()) != "robot") return wrong("its root is no <robot>");

  read_materials(*robot);
  if (auto error = read_joints(*robot)) return *error;
  std::vector<std::string> links;
  for (auto* e = robot->FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link"))
    links.push_back(attribute(*e, "name"));
  const auto frames = urdf_link_frames(source_.name, links, joints_);
  if (!frames) return frames.error();

  Result<AssemblyBuilder> builder = AssemblyBuilder::create(source_.name, "m", options_);
  if (!builder) return builder.error();
  std::size_t done = 0;
  for (auto* e = robot->FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    const double fraction = static_cast<double>(done++) / static_cast<double>(links.size());
    if (!report_progress(options_.progress, "reading", fraction)) return cancelled();
    if (auto error = add_link(*e, frames->at(attribute(*e, "name")), *builder)) return *error;
  }
  Result<Assembly> assembly = builder->finish(sha256(source_.bytes));
  if (assembly) assembly->deflection = deflection_ * builder->scale();
  return assembly;
}

Result<Vec3> UrdfParser::vector(const XMLElement& element, const char* name, Vec3 otherwise) const {
  const char* const text = element.Attribute(name);
  if (text == nullptr) return otherwise;
  const auto values = numbers<3>(text);
  if (!values)
    return wrong("line " + std::to_string(element.GetLineNum()) + ": " + name + " " + in_quotes(text) +
                 " is not three finite numbers");
  return Vec3{(*values)[0], (*values)[1], (*values)[2]};
}

Result<RigidTransform> UrdfParser::origin(const XMLElement& element) const {
  const XMLElement* const origin = element.FirstChildElement("origin");
  if (origin == nullptr) return RigidTransform{};
  const Result<Vec3> xyz = vector(*origin, "xyz", {});
  if (!xyz) return xyz.error();
  const Result<Vec3> rpy = vector(*origin, "rpy", {});
  if (!rpy) return rpy.error();
  return RigidTransform{rotation_from_rpy(*rpy), *xyz};
}

/// Materials may be defined in the robot or in a visual.
void UrdfParser::read_materials(const XMLElement& robot) {
  const auto remember = [this](const XMLElement& parent) {
    for (auto* m = parent.FirstChildElement("material"); m != nullptr; m = m->NextSiblingElement("material"))
      if (const std::optional<Color> c = color(parent); c && m->FirstChildElement("color") != nullptr)
        materials_.emplace(attribute(*m, "name"), *c);
  };
  remember(robot);
  for (auto* l = robot.FirstChildElement("link"); l != nullptr; l = l->NextSiblingElement("link"))
    for (auto* v = l->FirstChildElement("visual"); v != nullptr; v = v->NextSiblingElement("visual")) remember(*v);
}

std::optional<Color> UrdfParser::color(const XMLElement& visual) const {
  const XMLElement* const material = visual.FirstChildElement("material");
  if (material == nullptr) return std::nullopt;
  if (const XMLElement* const color = material->FirstChildElement("color")) {
    const auto rgba = numbers<4>(attribute(*color, "rgba"));
    if (!rgba) return std::nullopt;
    const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp((*rgba)[i], 0.0, 1.0)); };
    return Color{channel(0), channel(1), channel(2), channel(3)};
  }
  const auto named = materials_.find(attribute(*material, "name"));
  return named == materials_.end() ? std::nullopt : std::optional(named->second);
}

std::optional<Error> UrdfParser::read_joints(const XMLElement& robot) {
  for (auto* e = robot.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
    const XMLElement* const parent = e->FirstChildElement("parent");
    const XMLElement* const child = e->FirstChildElement("child");
    const std::string name = attribute(*e, "name");
    if (parent == nullptr || child == nullptr) return wrong("joint " + in_quotes(name) + " lacks its parent or child");
    const Result<RigidTransform> frame = origin(*e);
    if (!frame) return frame.error();
    joints_.push_back({name, attribute(*parent, "link"), attribute(*child, "link"), *frame});
  }
  return std::nullopt;
}

/// Adds a component of each visual, in a group named after the link; one visual, or all joined, without a group.
std::optional<Error> UrdfParser::add_link(const XMLElement& link, const RigidTransform& frame,
                                          AssemblyBuilder& builder) {
  Result<std::vector<Visual>> all = visuals(link);
  if (!all) return all.error();
  const std::string name = attribute(link, "name");
  if (all->size() == 1) {
    Visual& only = all->front();
    only.part.name = name;
    return builder.add(std::move(only.part), frame * only.link_from_visual);
  }
  if (options_.solids == Solids::Join) {
    std::vector<MeshPart> parts;
    for (Visual& visual : *all) {
      for (Vec3& p : visual.part.mesh.vertices) p = visual.link_from_visual * p;
      parts.push_back(std::move(visual.part));
    }
    MeshPart whole = joined(parts);
    whole.name = name;
    return builder.add(std::move(whole), frame);
  }
  for (Visual& visual : *all) {
    if (visual.part.name.empty()) visual.part.name = name;
    if (auto error = builder.add(std::move(visual.part), frame * visual.link_from_visual, name)) return error;
  }
  return std::nullopt;
}

Result<std::vector<Visual>> UrdfParser::visuals(const XMLElement& link) {
  std::vector<Visual> all;
  for (auto* v = link.FirstChildElement("visual"); v != nullptr; v = v->NextSiblingElement("visual")) {
    const Result<RigidTransform> link_from_visual = origin(*v);
    if (!link_from_visual) return link_from_visual.error();
    Result<MeshPart> part = geometry(*v);
    if (!part) return part.error();
    triangles_ += part->mesh.faces.size();
    if (triangles_ > options_.limits.triangles)
      return wrong("more than " + std::to_string(options_.limits.triangles) + " triangles");
    if (const std::string name = attribute(*v, "name"); !name.empty()) part->name = name;
    if (const std::optional<Color> own = color(*v)) part->color = *own;
    all.push_back({std::move(*part), *link_from_visual});
  }
  return all;
}

/// The mesh of a visual; of a mesh file, with its stem as name and its colour.
Result<MeshPart> UrdfParser::geometry(const XMLElement& visual) {
  const XMLElement* const geometry = visual.FirstChildElement("geometry");
  const XMLElement* const shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) return wrong("line " + std::to_string(visual.GetLineNum()) + ": a visual without geometry");
  if (std::string_view(shape->Name()) == "mesh") return mesh_file(*shape);
  Result<TriangleMesh> mesh = primitive(*shape);
  if (!mesh) return mesh.error();
  return MeshPart{{}, std::move(*mesh), {}, {}};
}

Result<MeshPart> UrdfParser::mesh_file(const XMLElement& mesh) {
  const Result<Vec3> scale = vector(mesh, "scale", {1, 1, 1});
  if (!scale) return scale.error();
  const std::string address = attribute(mesh, "filename");
  const Result<std::vector<MeshPart>> parts = load_mesh_(address);
  if (!parts) return parts.error();

  MeshPart whole = joined(*parts);
  whole.name = std::filesystem::path(address).stem().string();
  for (Vec3& p : whole.mesh.vertices) p = {scale->x * p.x, scale->y * p.y, scale->z * p.z};
  if (scale->x * scale->y * scale->z < 0)
    for (Face& f : whole.mesh.faces) std::swap(f.v[1], f.v[2]);
  return whole;
}

Result<TriangleMesh> UrdfParser::primitive(const XMLElement& shape) {
  const std::string_view kind = shape.Name();
  const auto radius = numbers<1>(attribute(shape, "radius"));
  const auto length = numbers<1>(attribute(shape, "length"));
  const auto size = numbers<3>(attribute(shape, "size"));
  TessellatedShape result;
  if (kind == "box" && size && (*size)[0] > 0 && (*size)[1] > 0 && (*size)[2] > 0) {
    result = tessellate_box({(*size)[0], (*size)[1], (*size)[2]});
  } else if (kind == "cylinder" && radius && length && (*radius)[0] > 0 && (*length)[0] > 0) {
    result = tessellate_cylinder((*radius)[0], (*length)[0]);
  } else if (kind == "sphere" && radius && (*radius)[0] > 0) {
    result = tessellate_sphere((*radius)[0]);
  } else {
    return wrong("line " + std::to_string(shape.GetLineNum()) + ": " + in_quotes(kind) +
                 " is no mesh, box, cylinder or sphere of positive size");
  }
  deflection_ = std::max(deflection_, result.deflection);
  return std::move(result.mesh);
}

}  // namespace

Result<Assembly> parse_urdf(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh) {
  return UrdfParser(source, options, load_mesh).parse();
}

Result<ImportedAssembly> read_urdf(const std::filesystem::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, std::min(kLargestUrdf, options.limits.file_bytes));
  if (!bytes) return bytes.error();
  UrdfMeshes meshes(file, options);
  Result<Assembly> assembly = parse_urdf({*bytes, file.filename().string()}, options,
                                         [&](const std::string& address) { return meshes.load(address); });
  if (!assembly) return assembly.error();
  return ImportedAssembly{std::move(*assembly), meshes.linked_files()};
}

}  // namespace dismantle
