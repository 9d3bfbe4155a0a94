// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/urdf/read_urdf.h"

#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/referenced_file.h"
#include "dismantle/formats/mesh/read_mesh.h"
#include "dismantle/formats/mesh/tessellate.h"
#include "dismantle/formats/urdf/urdf_kinematics.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;
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
  Result<MeshPart> link(const XMLElement& element);
  Result<TriangleMesh> geometry(const XMLElement& visual);
  Result<TriangleMesh> mesh_file(const XMLElement& mesh);
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
    Result<MeshPart> part = link(*e);
    if (!part) return part.error();
    const RigidTransform frame = frames->at(part->name);
    if (auto error = builder->add(std::move(*part), frame)) return *error;
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

/// All visuals of the link, in the link's frame [m].
Result<MeshPart> UrdfParser::link(const XMLElement& element) {
  MeshPart part;
  part.name = attribute(element, "name");
  bool is_first = true;
  for (auto* v = element.FirstChildElement("visual"); v != nullptr; v = v->NextSiblingElement("visual")) {
    const Result<RigidTransform> link_from_visual = origin(*v);
    if (!link_from_visual) return link_from_visual.error();
    Result<TriangleMesh> mesh = geometry(*v);
    if (!mesh) return mesh.error();
    triangles_ += mesh->faces.size();
    if (triangles_ > options_.limits.triangles)
      return wrong("more than " + std::to_string(options_.limits.triangles) + " triangles");

    const auto first = static_cast<std::uint32_t>(part.mesh.vertices.size());
    for (const Vec3& p : mesh->vertices) part.mesh.vertices.push_back(*link_from_visual * p);
    for (const Face& f : mesh->faces) part.mesh.faces.push_back({{first + f.v[0], first + f.v[1], first + f.v[2]}});
    if (is_first) part.color = color(*v).value_or(Color{});
    is_first = false;
  }
  return part;
}

Result<TriangleMesh> UrdfParser::geometry(const XMLElement& visual) {
  const XMLElement* const geometry = visual.FirstChildElement("geometry");
  const XMLElement* const shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) return wrong("line " + std::to_string(visual.GetLineNum()) + ": a visual without geometry");
  return std::string_view(shape->Name()) == "mesh" ? mesh_file(*shape) : primitive(*shape);
}

Result<TriangleMesh> UrdfParser::mesh_file(const XMLElement& mesh) {
  const Result<Vec3> scale = vector(mesh, "scale", {1, 1, 1});
  if (!scale) return scale.error();
  const Result<std::vector<MeshPart>> parts = load_mesh_(attribute(mesh, "filename"));
  if (!parts) return parts.error();

  TriangleMesh result;
  const bool mirrored = scale->x * scale->y * scale->z < 0;
  for (const MeshPart& part : *parts) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const Vec3& p : part.mesh.vertices)
      result.vertices.push_back({scale->x * p.x, scale->y * p.y, scale->z * p.z});
    for (const Face& f : part.mesh.faces) {
      const std::uint32_t b = f.v[mirrored ? 2 : 1], c = f.v[mirrored ? 1 : 2];
      result.faces.push_back({{first + f.v[0], first + b, first + c}});
    }
  }
  return result;
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

/// Candidate files for `address` in a URDF in `folder`, the most likely first.
std::vector<fs::path> candidates(const std::string& address, const fs::path& folder) {
  constexpr std::string_view kFile = "file://", kPackage = "package://";
  if (address.starts_with(kFile)) return {address.substr(kFile.size())};
  if (!address.starts_with(kPackage)) return {folder / address};

  const std::string path = address.substr(kPackage.size());
  const std::size_t slash = path.find('/');
  const std::string package = path.substr(0, slash);
  const std::string inside = slash == std::string::npos ? "" : path.substr(slash + 1);
  std::vector<fs::path> files;
  fs::path above = folder;
  while (true) {
    if (above.filename() == package) files.push_back(above / inside);
    files.push_back(above / path);
    if (!above.has_relative_path()) break;
    above = above.parent_path();
  }
  above = folder;
  files.push_back(above / inside);
  if (above.has_relative_path()) files.push_back(above.parent_path() / inside);
  return files;
}

/// Reads a mesh that a URDF refers to.
Result<std::vector<MeshPart>> load_named_mesh(const std::string& address, const fs::path& urdf,
                                              const std::vector<fs::path>& folders, const ImportOptions& options) {
  const fs::path base = fs::absolute(urdf).lexically_normal().parent_path();
  std::string why;
  for (const fs::path& candidate : candidates(address, base)) {
    const Result<fs::path> file = referenced_file(candidate, base, folders);
    if (!file) {
      if (why.empty()) why = file.error().message;
      continue;
    }
    if (!is_mesh_file(*file))
      return malformed({{}, urdf.filename().string()}, "URDF",
                       "mesh " + in_quotes(address) + " is no OBJ, STL or PLY file");
    Result<MeshFile> mesh = read_mesh_file(*file, options);
    if (!mesh) return mesh.error();
    return std::move(mesh->parts);
  }
  return unreadable_as(urdf.filename(), "URDF",
                       {ErrorKind::Unreadable, "it refers to " + in_quotes(address) + ", which " + why});
}

}  // namespace

Result<Assembly> parse_urdf(const MeshSource& source, const ImportOptions& options, const MeshLoader& load_mesh) {
  return UrdfParser(source, options, load_mesh).parse();
}

Result<Assembly> read_urdf(const fs::path& file, const ImportOptions& options) {
  const Result<std::string> bytes = read_file(file, std::min(kLargestUrdf, options.limits.file_bytes));
  if (!bytes) return bytes.error();
  ImportOptions mesh_options = options;  // progress is reported a link at a time
  mesh_options.progress = nullptr;
  const std::vector<fs::path> folders = reference_folders(file, options);
  return parse_urdf({*bytes, file.filename().string()}, options,
                    [&](const std::string& address) { return load_named_mesh(address, file, folders, mesh_options); });
}

}  // namespace dismantle
