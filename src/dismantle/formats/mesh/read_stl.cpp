// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_stl.h"

#include "dismantle/files/byte_order.h"
#include "dismantle/files/text_scan.h"

namespace dismantle {

namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of text, then the number of triangles
constexpr std::size_t kTriangleBytes = 50;  // normal and corners as float32, two bytes of attributes
constexpr std::size_t kTrianglesPerReport = 65536;

Error too_many(const MeshSource& source, const ImportOptions& options) {
  return malformed(source, "STL", "more than " + std::to_string(options.limits.triangles) + " triangles");
}

void append_triangle(TriangleMesh& mesh, const Triangle& t) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {t[0], t[1], t[2]});
  mesh.faces.push_back({{first, first + 1, first + 2}});
}

Result<std::vector<MeshPart>> parse_binary(const MeshSource& source, const ImportOptions& options) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < kHeaderBytes) return malformed(source, "STL", "it ends within the header");
  const std::size_t count = number_at<std::uint32_t>(bytes.data() + 80, std::endian::little);
  if (count > (bytes.size() - kHeaderBytes) / kTriangleBytes)
    return malformed(source, "STL",
                     "it claims " + std::to_string(count) + " triangles and ends after " +
                         std::to_string((bytes.size() - kHeaderBytes) / kTriangleBytes));
  if (count > options.limits.triangles) return too_many(source, options);

  MeshPart part;
  part.mesh.vertices.reserve(3 * count);
  part.mesh.faces.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* data = bytes.data() + kHeaderBytes + i * kTriangleBytes + 12;
    Triangle t;
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis, data += 4) t[corner][axis] = number_at<float>(data, std::endian::little);
    if (!is_finite(t[0]) || !is_finite(t[1]) || !is_finite(t[2]))
      return malformed(source, "STL", "triangle " + std::to_string(i + 1) + ": a coordinate is not a finite number");
    append_triangle(part.mesh, t);
    if (i % kTrianglesPerReport == 0 &&
        !report_progress(options.progress, "reading", static_cast<double>(i) / static_cast<double>(count)))
      return cancelled();
  }
  std::vector<MeshPart> parts;
  parts.push_back(std::move(part));
  return parts;
}

/// Reads the words of an ASCII STL.
class AsciiStl {
 public:
  AsciiStl(const MeshSource& source, const ImportOptions& options)
      : source_(source), options_(options), words_(source.bytes) {}

  Result<std::vector<MeshPart>> parse();

 private:
  std::optional<Error> solid();
  std::optional<Error> facet();
  std::optional<Error> corner(Vec3& point);
  /// Consumes the next word; an Error if it is not the expected one.
  std::optional<Error> expect(std::string_view wanted);
  Error here(const std::string& why) const {
    return malformed(source_, "STL", "line " + std::to_string(words_.line()) + ": " + why);
  }

  const MeshSource& source_;
  const ImportOptions& options_;
  WordReader words_;
  std::vector<MeshPart> parts_;
  std::size_t triangles_ = 0;
};

Result<std::vector<MeshPart>> AsciiStl::parse() {
  for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
    if (lower_case(word) != "solid") return here(in_quotes(word) + " where a solid should begin");
    if (auto error = solid()) return *error;
  }
  return std::move(parts_);
}

std::optional<Error> AsciiStl::solid() {
  if (parts_.size() == options_.limits.components)
    return here("more than " + std::to_string(options_.limits.components) + " solids");
  parts_.emplace_back().name = words_.rest_of_line();
  while (true) {
    const std::string_view word = words_.next();
    const std::string keyword = lower_case(word);
    if (keyword == "endsolid") break;
    if (word.empty()) return here("it ends within a solid");
    if (keyword != "facet") return here(in_quotes(word) + " where a facet should begin");
    if (auto error = facet()) return error;
  }
  words_.rest_of_line();
  if (parts_.back().mesh.faces.empty()) parts_.pop_back();
  return std::nullopt;
}

std::optional<Error> AsciiStl::facet() {
  if (auto error = expect("normal")) return error;
  for (int i = 0; i < 3; ++i) words_.next();  // normals follow from the corners; many files have them wrong
  if (auto error = expect("outer")) return error;
  if (auto error = expect("loop")) return error;
  Triangle t;
  for (int i = 0; i < 3; ++i)
    if (auto error = corner(t[i])) return error;
  if (auto error = expect("endloop")) return error;
  if (auto error = expect("endfacet")) return error;

  append_triangle(parts_.back().mesh, t);
  if (++triangles_ > options_.limits.triangles) return too_many(source_, options_);
  const double left = static_cast<double>(words_.rest().size()) / static_cast<double>(source_.bytes.size());
  if (triangles_ % kTrianglesPerReport == 0 && !report_progress(options_.progress, "reading", 1 - left))
    return cancelled();
  return std::nullopt;
}

std::optional<Error> AsciiStl::corner(Vec3& point) {
  if (auto error = expect("vertex")) return error;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = words_.next();
    const std::optional<double> value = to_double(word);
    if (!value) return here("coordinate " + in_quotes(word) + " is not a finite number");
    point[axis] = *value;
  }
  return std::nullopt;
}

std::optional<Error> AsciiStl::expect(std::string_view wanted) {
  const std::string_view word = words_.next();
  if (word == wanted || lower_case(word) == wanted) return std::nullopt;
  if (word.empty()) return here("it ends within a facet");
  return here(in_quotes(word) + " where \"" + std::string(wanted) + "\" should stand");
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() >= kHeaderBytes) {
    const std::size_t count = number_at<std::uint32_t>(bytes.data() + 80, std::endian::little);
    if (bytes.size() == kHeaderBytes + count * kTriangleBytes) return true;
    if (bytes.substr(0, kHeaderBytes).find('\0') != std::string_view::npos) return true;
  }
  WordReader words(bytes);
  return lower_case(words.next().substr(0, 6)) != "solid";
}

Result<std::vector<MeshPart>> parse_stl(const MeshSource& source, const ImportOptions& options) {
  return is_binary_stl(source.bytes) ? parse_binary(source, options) : AsciiStl(source, options).parse();
}

}  // namespace dismantle
