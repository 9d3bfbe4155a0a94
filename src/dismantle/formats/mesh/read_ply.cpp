// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/mesh/read_ply.h"

#include "dismantle/files/byte_order.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/mesh/ply_header.h"
#include "dismantle/formats/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dismantle {

namespace {

constexpr std::uint64_t kRowsPerReport = 65536;

/// Reads the numbers of a binary body in sequence.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view body, std::endian order) : rest_(body), order_(order) {}

  /// The next number; none at the end of the body.
  std::optional<double> next(PlyType type) {
    const std::size_t size = byte_count(type);
    if (rest_.size() < size) return std::nullopt;
    const char* data = rest_.data();
    rest_.remove_prefix(size);
    switch (type) {
      case PlyType::Int8:
        return number_at<std::int8_t>(data, order_);
      case PlyType::Uint8:
        return number_at<std::uint8_t>(data, order_);
      case PlyType::Int16:
        return number_at<std::int16_t>(data, order_);
      case PlyType::Uint16:
        return number_at<std::uint16_t>(data, order_);
      case PlyType::Int32:
        return number_at<std::int32_t>(data, order_);
      case PlyType::Uint32:
        return number_at<std::uint32_t>(data, order_);
      case PlyType::Float32:
        return static_cast<double>(number_at<float>(data, order_));
      case PlyType::Float64:
        return number_at<double>(data, order_);
    }
    return std::nullopt;
  }

  bool skip(PlyType type, std::size_t count) {
    if (count > rest_.size() / byte_count(type)) return false;
    rest_.remove_prefix(count * byte_count(type));
    return true;
  }

  std::size_t bytes_left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::endian order_;
};

/// Reads the numbers of an ASCII body in sequence.
class TextNumbers {
 public:
  explicit TextNumbers(std::string_view body) : words_(body) {}

  /// The next number; none at the end of the body or if the word is not a number.
  std::optional<double> next(PlyType) { return to_double(words_.next()); }

  bool skip(PlyType, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      if (words_.next().empty()) return false;
    return true;
  }

  std::size_t bytes_left() const { return words_.rest().size(); }

 private:
  WordReader words_;
};

/// Reads the body of a PLY file in either encoding.
template <class Numbers>
class BodyParser {
 public:
  BodyParser(const MeshSource& source, const ImportOptions& options, Numbers numbers)
      : source_(source), options_(options), numbers_(numbers) {}

  Result<MeshPart> parse(const PlyHeader& header) {
    for (const PlyElement& element : header.elements)
      if (auto error = read(element)) return *error;
    return mesh();
  }

 private:
  std::optional<Error> read(const PlyElement& element);
  std::optional<Error> read_vertices(const PlyElement& element);
  std::optional<Error> read_faces(const PlyElement& element, std::size_t indices);
  std::optional<Error> read_corners(const PlyProperty& list, std::uint64_t row);
  Result<MeshPart> mesh();
  bool skip(const PlyProperty& property);
  std::optional<std::size_t> list_length(const PlyProperty& list);
  bool report(std::uint64_t row) const {
    const double left = static_cast<double>(numbers_.bytes_left()) / static_cast<double>(source_.bytes.size());
    return row % kRowsPerReport != 0 || report_progress(options_.progress, "reading", 1 - left);
  }
  Error in_row(std::string_view element, std::uint64_t row, const std::string& why) const {
    return malformed(source_, "PLY", std::string(element) + " " + std::to_string(row) + ": " + why);
  }

  const MeshSource& source_;
  const ImportOptions& options_;
  Numbers numbers_;
  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> polygon_begin_;
  std::size_t triangles_ = 0;
};

template <class Numbers>
std::optional<Error> BodyParser<Numbers>::read(const PlyElement& element) {
  if (element.properties.empty()) return std::nullopt;
  if (element.name == "vertex") return read_vertices(element);
  if (element.name == "face") {
    std::optional<std::size_t> indices = element.find("vertex_indices");
    if (!indices) indices = element.find("vertex_index");
    if (indices) return read_faces(element, *indices);
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (!report(row)) return cancelled();
    for (const PlyProperty& property : element.properties)
      if (!skip(property)) return in_row(element.name, row, "the file ends here, or no number stands here");
  }
  return std::nullopt;
}

template <class Numbers>
std::optional<Error> BodyParser<Numbers>::read_vertices(const PlyElement& element) {
  constexpr std::string_view kNames[] = {"x", "y", "z"};
  std::vector<int> axis_of(element.properties.size(), -1);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<std::size_t> place = element.find(kNames[axis]);
    if (!place || element.properties[*place].length_type)
      return malformed(source_, "PLY", "its vertices have no coordinate " + std::string(kNames[axis]));
    axis_of[*place] = axis;
  }
  if (element.count + vertices_.size() >= std::numeric_limits<std::uint32_t>::max())
    return malformed(source_, "PLY", "too many vertices");

  vertices_.reserve(vertices_.size() + element.count);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (!report(row)) return cancelled();
    Vec3 point;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (axis_of[i] < 0) {
        if (!skip(element.properties[i])) return in_row("vertex", row, "the file ends here");
        continue;
      }
      const std::optional<double> value = numbers_.next(element.properties[i].type);
      if (!value || !std::isfinite(*value))
        return in_row("vertex", row,
                      numbers_.bytes_left() == 0 ? "the file ends here" : "a coordinate is not a finite number");
      point[axis_of[i]] = *value;
    }
    vertices_.push_back(point);
  }
  return std::nullopt;
}

template <class Numbers>
std::optional<Error> BodyParser<Numbers>::read_faces(const PlyElement& element, std::size_t indices) {
  const PlyProperty& list = element.properties[indices];
  if (!list.length_type || !is_integer(list.type))
    return malformed(source_, "PLY", "the vertex indices of its faces are no lists of integers");
  polygon_begin_.reserve(polygon_begin_.size() + element.count);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (!report(row)) return cancelled();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (i != indices) {
        if (!skip(element.properties[i])) return in_row("face", row, "the file ends here");
      } else if (auto error = read_corners(list, row)) {
        return error;
      }
    }
  }
  return std::nullopt;
}

template <class Numbers>
std::optional<Error> BodyParser<Numbers>::read_corners(const PlyProperty& list, std::uint64_t row) {
  const std::optional<std::size_t> count = list_length(list);
  if (!count) return in_row("face", row, "the file ends here, or its number of corners makes no sense");
  if (*count == 0) return std::nullopt;
  triangles_ += std::max<std::size_t>(*count, 3) - 2;
  if (triangles_ > options_.limits.triangles)
    return malformed(source_, "PLY", "more than " + std::to_string(options_.limits.triangles) + " triangles");

  polygon_begin_.push_back(corners_.size());
  for (std::size_t i = 0; i < *count; ++i) {
    const std::optional<double> index = numbers_.next(list.type);
    if (!index) return in_row("face", row, "the file ends here, or no number stands here");
    if (!(*index >= 0 && *index < std::numeric_limits<std::uint32_t>::max()) || *index != std::floor(*index))
      return in_row("face", row, "a corner is no vertex index");
    corners_.push_back(static_cast<std::uint32_t>(*index));
  }
  return std::nullopt;
}

/// The length of a list, checked against the rest of the body.
template <class Numbers>
std::optional<std::size_t> BodyParser<Numbers>::list_length(const PlyProperty& list) {
  const std::optional<double> length = numbers_.next(*list.length_type);
  if (!length || !(*length >= 0) || *length > static_cast<double>(numbers_.bytes_left())) return std::nullopt;
  return static_cast<std::size_t>(*length);
}

template <class Numbers>
bool BodyParser<Numbers>::skip(const PlyProperty& property) {
  if (!property.length_type) return numbers_.skip(property.type, 1);
  const std::optional<std::size_t> length = list_length(property);
  return length && numbers_.skip(property.type, *length);
}

template <class Numbers>
Result<MeshPart> BodyParser<Numbers>::mesh() {
  const std::size_t polygons = polygon_begin_.size();
  polygon_begin_.push_back(corners_.size());
  for (std::size_t i = 0; i < polygons; ++i)
    for (std::size_t k = polygon_begin_[i]; k < polygon_begin_[i + 1]; ++k)
      if (corners_[k] >= vertices_.size())
        return malformed(source_, "PLY",
                         "polygon " + std::to_string(i) + " names vertex " + std::to_string(corners_[k]) + " of " +
                             std::to_string(vertices_.size()));

  MeshPart part;
  part.mesh.faces.reserve(triangles_);
  PolygonTriangulator triangulator;
  for (std::size_t i = 0; i < polygons; ++i) {
    const std::size_t begin = polygon_begin_[i];
    triangulator.append(Span<const std::uint32_t>(corners_.data() + begin, polygon_begin_[i + 1] - begin), vertices_,
                        part.mesh.faces);
  }
  part.mesh.vertices = std::move(vertices_);
  return part;
}

}  // namespace

Result<MeshPart> parse_ply(const MeshSource& source, const ImportOptions& options) {
  const Result<PlyHeader> header = parse_ply_header(source);
  if (!header) return header.error();
  const std::string_view body = source.bytes.substr(header->body_offset);
  if (header->format == PlyFormat::Ascii) return BodyParser(source, options, TextNumbers(body)).parse(*header);
  const std::endian order = header->format == PlyFormat::BinaryBigEndian ? std::endian::big : std::endian::little;
  return BodyParser(source, options, BinaryNumbers(body, order)).parse(*header);
}

}  // namespace dismantle
