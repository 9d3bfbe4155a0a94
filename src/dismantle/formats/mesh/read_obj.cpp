// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_obj.h"

#include "dismantle/files/text_scan.h"
#include "dismantle/formats/mesh/polygon.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

constexpr std::size_t kLinesPerReport = 65536;

/// A named run of polygons, from `first` to the start of the next section.
struct Section {
  std::string name;
  std::size_t first = 0;
};

/// Starts a section at polygon `first`; a section without polygons is dropped, so that there are never more sections
/// than polygons.
void begin_section(std::vector<Section>& sections, std::string_view name, std::size_t first) {
  if (sections.empty() || sections.back().first != first) sections.push_back({"", first});
  sections.back().name = name;
}

/// Reads the statements of an OBJ file; sections become components at the end.
class ObjParser {
 public:
  ObjParser(const MeshSource& source, const ImportOptions& options)
      : source_(source), options_(options), lines_(source.bytes) {}

  std::optional<Error> read();
  Result<ObjModel> model();

 private:
  std::optional<Error> statement(std::string_view line);
  std::optional<Error> vertex(std::string_view rest);
  std::optional<Error> face(std::string_view rest);
  std::optional<Error> corner(std::string_view word);
  Error at_line(std::size_t line, const std::string& why) const {
    return malformed(source_, "OBJ", "line " + std::to_string(line) + ": " + why);
  }
  MeshPart part(const Section& section, std::size_t end);
  std::string material_of(std::size_t polygon) const;
  void compact(TriangleMesh& mesh);

  const MeshSource& source_;
  const ImportOptions& options_;
  LineReader lines_;

  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> polygon_begin_;
  std::vector<Section> objects_, groups_, materials_;
  std::vector<std::string> material_files_;
  std::size_t triangles_ = 0;
  std::size_t largest_index_ = 0;       // named by a face, from 1 on
  std::size_t largest_index_line_ = 0;  // where

  PolygonTriangulator triangulator_;
  std::vector<std::uint32_t> local_index_;  // of each vertex within the part that is made
};

std::optional<Error> ObjParser::read() {
  while (const std::optional<std::string_view> line = lines_.next_joined()) {
    if (lines_.line() % kLinesPerReport == 0) {
      const double left = static_cast<double>(lines_.rest().size()) / static_cast<double>(source_.bytes.size());
      if (!report_progress(options_.progress, "reading", 1 - left)) return cancelled();
    }
    if (auto error = statement(*line)) return error;
  }
  if (largest_index_ > vertices_.size())
    return at_line(largest_index_line_,
                   "a face names vertex " + std::to_string(largest_index_) + " of " + std::to_string(vertices_.size()));
  return std::nullopt;
}

std::optional<Error> ObjParser::statement(std::string_view line) {
  const std::string_view keyword = take_word(line);
  if (keyword.empty() || keyword[0] == '#') return std::nullopt;
  if (keyword == "v") return vertex(line);
  if (keyword == "f") return face(line);
  if (keyword == "o") begin_section(objects_, trimmed(line), polygon_begin_.size());
  if (keyword == "g") begin_section(groups_, trimmed(line), polygon_begin_.size());
  if (keyword == "usemtl") begin_section(materials_, trimmed(line), polygon_begin_.size());
  if (keyword == "mtllib") material_files_.emplace_back(trimmed(line));
  return std::nullopt;
}

std::optional<Error> ObjParser::vertex(std::string_view rest) {
  Vec3 point;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(rest);
    const std::optional<double> value = to_double(word);
    if (!value) return at_line(lines_.line(), "coordinate " + in_quotes(word) + " of a vertex is not a finite number");
    point[i] = *value;
  }
  vertices_.push_back(point);
  return std::nullopt;
}

std::optional<Error> ObjParser::face(std::string_view rest) {
  const std::size_t begin = corners_.size();
  for (std::string_view word = take_word(rest); !word.empty() && word[0] != '#'; word = take_word(rest))
    if (auto error = corner(word)) return error;
  const std::size_t count = corners_.size() - begin;
  if (count == 0) return at_line(lines_.line(), "a face without corners");
  polygon_begin_.push_back(begin);
  triangles_ += std::max<std::size_t>(count, 3) - 2;
  if (triangles_ > options_.limits.triangles)
    return at_line(lines_.line(), "more than " + std::to_string(options_.limits.triangles) + " triangles");
  return std::nullopt;
}

std::optional<Error> ObjParser::corner(std::string_view word) {
  // "7", "7/1", "7//3" or "7/1/3": only the vertex counts here.
  const std::size_t slash = word.find('/');
  const std::optional<std::int64_t> named = to_integer(word.substr(0, slash));
  const bool clean =
      slash == std::string_view::npos || word.find_first_not_of("+-0123456789/", slash) == std::string_view::npos;
  if (!named || !clean) return at_line(lines_.line(), in_quotes(word) + " is not a corner of a face");

  const auto defined = static_cast<std::int64_t>(vertices_.size());
  const std::int64_t index = *named < 0 ? defined + 1 + *named : *named;
  if (*named == 0 || index < 1 || index >= std::int64_t{std::numeric_limits<std::uint32_t>::max()})
    return at_line(lines_.line(),
                   "a face names vertex " + std::to_string(*named) + " of " + std::to_string(defined) + " so far");
  if (static_cast<std::size_t>(index) > largest_index_) {
    largest_index_ = static_cast<std::size_t>(index);
    largest_index_line_ = lines_.line();
  }
  corners_.push_back(static_cast<std::uint32_t>(index - 1));
  return std::nullopt;
}

Result<ObjModel> ObjParser::model() {
  ObjModel model;
  model.material_files = std::move(material_files_);
  std::vector<Section>& sections = objects_.empty() ? groups_ : objects_;
  if (sections.empty() || sections.front().first != 0) sections.insert(sections.begin(), Section{});
  const std::size_t polygons = polygon_begin_.size();
  polygon_begin_.push_back(corners_.size());

  local_index_.assign(vertices_.size(), 0);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::size_t end = i + 1 < sections.size() ? sections[i + 1].first : polygons;
    if (end == sections[i].first) continue;
    if (model.parts.size() == options_.limits.components)
      return malformed(source_, "OBJ", "more than " + std::to_string(options_.limits.components) + " sections");
    model.parts.push_back(part(sections[i], end));
    const double fraction = static_cast<double>(end) / static_cast<double>(polygons);
    if (!report_progress(options_.progress, "splitting into components", fraction)) return cancelled();
  }
  return model;
}

MeshPart ObjParser::part(const Section& section, std::size_t end) {
  MeshPart part;
  part.name = section.name;
  part.material = material_of(section.first);
  part.mesh.faces.reserve(end - section.first);
  for (std::size_t i = section.first; i < end; ++i) {
    const std::size_t begin = polygon_begin_[i];
    const Span<const std::uint32_t> corners(corners_.data() + begin, polygon_begin_[i + 1] - begin);
    triangulator_.append(corners, vertices_, part.mesh.faces);
  }
  compact(part.mesh);
  return part;
}

std::string ObjParser::material_of(std::size_t polygon) const {
  const auto after = std::upper_bound(materials_.begin(), materials_.end(), polygon,
                                      [](std::size_t p, const Section& s) { return p < s.first; });
  return after == materials_.begin() ? "" : std::prev(after)->name;
}

/// Copies the vertices that the faces use into the mesh, in file order, and renumbers the faces.
void ObjParser::compact(TriangleMesh& mesh) {
  std::vector<std::uint32_t> used;
  for (const Face& face : mesh.faces)
    for (const std::uint32_t v : face.v)
      if (local_index_[v] == 0) {
        local_index_[v] = 1;
        used.push_back(v);
      }
  if (!std::is_sorted(used.begin(), used.end())) std::sort(used.begin(), used.end());

  mesh.vertices.reserve(used.size());
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    local_index_[used[i]] = i;
    mesh.vertices.push_back(vertices_[used[i]]);
  }
  for (Face& face : mesh.faces)
    for (std::uint32_t& v : face.v) v = local_index_[v];
  for (const std::uint32_t v : used) local_index_[v] = 0;
}

/// Sets the channel to the next word if that is a number.
void take_channel(std::string_view& rest, float& channel) {
  if (const std::optional<double> value = to_double(take_word(rest)))
    channel = static_cast<float>(std::clamp(*value, 0.0, 1.0));
}

}  // namespace

Result<ObjModel> parse_obj(const MeshSource& source, const ImportOptions& options) {
  ObjParser parser(source, options);
  if (auto error = parser.read()) return *error;
  return parser.model();
}

std::unordered_map<std::string, Color> parse_mtl(std::string_view text) {
  std::unordered_map<std::string, Color> colors;
  Color* current = nullptr;
  LineReader lines(text);
  while (std::optional<std::string_view> line = lines.next()) {
    const std::string_view keyword = take_word(*line);
    if (keyword == "newmtl") current = &colors[std::string(trimmed(*line))];
    if (current == nullptr) continue;
    if (keyword == "Kd")
      for (float* const channel : {&current->r, &current->g, &current->b}) take_channel(*line, *channel);
    if (keyword == "d") take_channel(*line, current->a);
  }
  return colors;
}

}  // namespace dismantle
