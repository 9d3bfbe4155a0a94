// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/write_mesh.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/byte_order.h"
#include "dismantle/files/text_name.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>
#include <unordered_set>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// The shortest text that reads back as the same double.
void append_number(std::string& text, double value) {
  char buffer[32];
  text.append(buffer, std::to_chars(std::begin(buffer), std::end(buffer), value).ptr);
}

void append_point(std::string& text, std::string_view keyword, Vec3 p) {
  text += keyword;
  for (const double c : {p.x, p.y, p.z}) {
    text += ' ';
    append_number(text, c);
  }
  text += '\n';
}

template <class T>
void append_bytes(std::string& bytes, T value) {
  const auto number = little_endian_bytes(value);
  bytes.append(number.data(), number.size());
}

/// A name that survives a round trip through a line of text.
std::string line_name(const std::string& name) {
  std::string line = clean_name(name);
  if (line.empty()) return "_";
  for (char* const end : {&line.front(), &line.back()})
    if (*end == ' ' || *end == '\\') *end = '_';
  return line;
}

/// One section, its vertices numbered from `first_vertex` (OBJ counts from 1).
std::string obj_section(const Component& component, std::size_t first_vertex) {
  std::string text = "o " + line_name(component.name) + "\n";
  for (const Vec3& p : assembled_vertices(component)) append_point(text, "v", p);
  for (const Face& face : component.mesh->faces) {
    text += 'f';
    for (const std::uint32_t v : face.v) text += ' ' + std::to_string(first_vertex + v);
    text += '\n';
  }
  return text;
}

void write_binary_stl(AtomicFile& out, const Assembly& assembly) {
  std::string bytes = "dismantle, binary STL in mm";  // must not begin with "solid"
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(triangle_count(assembly)));
  for (const Component& component : assembly.components) {
    const TriangleMesh mesh = assembled_mesh(component);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      for (const Vec3& p : {normalized(normal_unscaled(t)), t[0], t[1], t[2]})
        for (const double c : {p.x, p.y, p.z}) append_bytes(bytes, static_cast<float>(c));
      append_bytes(bytes, std::uint16_t{0});
    }
    out.write(bytes);
    bytes.clear();
  }
}

void write_ascii_stl(AtomicFile& out, const Assembly& assembly) {
  for (const Component& component : assembly.components) {
    const std::string name = line_name(component.name);
    std::string text = "solid " + name + "\n";
    const TriangleMesh mesh = assembled_mesh(component);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      append_point(text, "facet normal", normalized(normal_unscaled(t)));
      text += "outer loop\n";
      for (const Vec3& p : t.corner) append_point(text, "vertex", p);
      text += "endloop\nendfacet\n";
    }
    text += "endsolid " + name;
    text += "\n";
    out.write(text);
  }
}

void write_ply_vertices(AtomicFile& out, const Component& component) {
  const auto level = [](float channel) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(channel, 0.0f, 1.0f) * 255.0f));
  };
  std::string bytes;
  for (const Vec3& p : assembled_vertices(component)) {
    for (const double c : {p.x, p.y, p.z}) append_bytes(bytes, c);
    for (const float c : {component.color.r, component.color.g, component.color.b}) append_bytes(bytes, level(c));
  }
  out.write(bytes);
}

void write_ply_faces(AtomicFile& out, const Component& component, std::uint32_t first_vertex) {
  std::string bytes;
  for (const Face& face : component.mesh->faces) {
    append_bytes(bytes, std::uint8_t{3});
    for (const std::uint32_t v : face.v) append_bytes(bytes, first_vertex + v);
  }
  out.write(bytes);
}

/// Writes one file for each component into an existing folder.
Result<Done> fill_folder(const fs::path& folder, const Assembly& assembly) {
  std::unordered_set<std::string> taken;
  for (const Component& component : assembly.components) {
    const std::string stem = file_stem(component.name);
    std::string name = stem;
    for (int repeat = 2; !taken.insert(name).second; ++repeat) name = stem + "#" + std::to_string(repeat);
    Result<Done> done = write_file(folder / (name + ".obj"), obj_section(component, 1));
    if (!done) return done;
  }
  return Done{};
}

}  // namespace

Result<Done> write_obj(const fs::path& file, const Assembly& assembly) {
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  out->write("# dismantle, lengths in mm\n");
  std::size_t first_vertex = 1;
  for (const Component& component : assembly.components) {
    out->write(obj_section(component, first_vertex));
    first_vertex += component.mesh->vertices.size();
  }
  return out->commit();
}

Result<Done> write_stl(const fs::path& file, const Assembly& assembly, StlForm form) {
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  if (form == StlForm::Binary) {
    write_binary_stl(*out, assembly);
  } else {
    write_ascii_stl(*out, assembly);
  }
  return out->commit();
}

Result<Done> write_ply(const fs::path& file, const Assembly& assembly) {
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  std::size_t vertices = 0;
  for (const Component& component : assembly.components) vertices += component.mesh->vertices.size();
  out->write("ply\nformat binary_little_endian 1.0\ncomment dismantle, lengths in mm\nelement vertex " +
             std::to_string(vertices) +
             "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar green\n"
             "property uchar blue\nelement face " +
             std::to_string(triangle_count(assembly)) + "\nproperty list uchar uint vertex_indices\nend_header\n");
  for (const Component& component : assembly.components) write_ply_vertices(*out, component);
  std::uint32_t first_vertex = 0;
  for (const Component& component : assembly.components) {
    write_ply_faces(*out, component, first_vertex);
    first_vertex += static_cast<std::uint32_t>(component.mesh->vertices.size());
  }
  return out->commit();
}

Result<Done> write_mesh_folder(const fs::path& folder, const Assembly& assembly) {
  const auto failure = [&](const std::string& why) {
    return Error{ErrorKind::Failed,
                 folder.string() + " cannot be written (" + why + "); name a folder that does not exist yet"};
  };
  std::error_code error;
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();
  if (fs::exists(target, error) && !(fs::is_directory(target, error) && fs::is_empty(target, error)))
    return failure("it exists and is no empty folder");

  fs::path temporary = target;
  temporary += ".dismantle-" + std::to_string(::getpid()) + ".tmp";
  if (!fs::create_directory(temporary, error)) return failure(error ? error.message() : "its temporary name is taken");
  Result<Done> filled = fill_folder(temporary, assembly);
  if (filled) fs::rename(temporary, target, error);
  std::error_code ignored;
  if (!filled || error) fs::remove_all(temporary, ignored);
  if (!filled) return filled;
  return error ? Result<Done>(failure(error.message())) : Result<Done>(Done{});
}

}  // namespace dismantle
