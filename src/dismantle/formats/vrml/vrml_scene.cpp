// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/vrml/vrml_scene.h"

#include "dismantle/files/text_name.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/vrml/vrml_geometry.h"
#include "dismantle/formats/vrml/vrml_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace dismantle {

namespace {

constexpr int kDeepest = 300;                   // nodes within nodes
constexpr std::size_t kMaxCopied = 20'000'000;  // triangles of shapes that use the geometry of others

/// What a node gives to the one that it is in. Others give nothing.
struct Value {
  enum class Kind { None, Node, Geometry, Points, Color } kind = Kind::None;
  std::size_t index = 0;  // of a node of the scene, a geometry, or points
  dismantle::Color color;
};

/// True for the types of nodes that hold others in the scene.
bool is_group(std::string_view type) {
  for (const std::string_view group : {"Group", "Transform", "Anchor", "Billboard", "Collision", "Switch", "LOD"})
    if (type == group) return true;
  return false;
}

class VrmlParser {
 public:
  VrmlParser(const MeshSource& source, std::size_t triangle_limit)
      : source_(source), words_(source.bytes), triangles_left_(triangle_limit), copied_left_(kMaxCopied) {}

  Result<VrmlScene> parse() {
    while (!words_.peek().empty()) {
      Value value;
      if (!statement(words_.next(), "", 0, value)) return *error_;
      if (value.kind == Value::Kind::Node) result_.scene.roots.push_back(value.index);
    }
    join_sheets(result_.scene.roots, "");
    return std::move(result_);
  }

 private:
  bool fail(const std::string& why) {
    error_ = malformed(source_, "VRML", "line " + std::to_string(words_.line()) + ": " + why);
    return false;
  }

  /// A node, USE, PROTO or ROUTE that begins with `word`. The name is that of what is around it.
  bool statement(std::string_view word, const std::string& outer, int depth, Value& value) {
    if (depth > kDeepest) return fail("nodes are nested too deep");
    if (word == "DEF") {
      const std::string name(words_.next());
      if (!node(words_.next(), name, depth, value)) return false;
      if (value.kind == Value::Kind::Node) sheets_.erase(value.index);
      defined_[name] = value;
      return true;
    }
    if (word == "USE") {
      const auto found = defined_.find(std::string(words_.next()));
      if (found == defined_.end()) return fail("USE of a name without DEF");
      value = found->second;
      return true;
    }
    if (word == "NULL") return true;
    if (word == "PROTO" || word == "EXTERNPROTO") return prototype(word == "EXTERNPROTO");
    if (word == "ROUTE") {
      for (int i = 0; i < 3; ++i) words_.next();
      return true;
    }
    return node(word, outer, depth, value);
  }

  bool node(std::string_view type, const std::string& name, int depth, Value& value) {
    const bool is_word =
        !type.empty() && ((type[0] >= 'A' && type[0] <= 'Z') || prototypes_.contains(std::string(type)));
    if (!is_word || words_.next() != "{") return fail(in_quotes(type) + " where a node should begin");
    ++depth;
    if (is_group(type)) return group(type, name, depth, value);
    if (type == "Shape") return shape(name, depth, value);
    if (type == "IndexedFaceSet") return face_set(depth, value);
    if (type == "Box" || type == "Sphere" || type == "Cylinder" || type == "Cone") return solid(type, value);
    if (type == "Coordinate") return coordinate(depth, value);
    if (type == "Appearance") return colored("material", depth, value);
    if (type == "Material") return material(depth, value);
    if (type == "Inline" || type == "Extrusion" || type == "ElevationGrid" || prototypes_.contains(std::string(type)))
      return fail(std::string(type == "Inline" ? "a file within the file (" : "a shape that is not supported (") +
                  clean_name(type.substr(0, 40)) + ")");
    return skip_to("}", depth);
  }

  /// Calls `read` with each field's name until the brace that closes the node. A field that it does not know is
  /// skipped.
  template <class Read>
  bool fields(int depth, const Read& read) {
    for (std::string_view word = words_.next(); word != "}"; word = words_.next()) {
      if (word.empty()) return fail("it ends too early");
      bool known = false;
      if (!read(word, known)) return false;
      if (!known && !skip_value(word, depth)) return false;
    }
    return true;
  }

  /// Skips what follows a field's name. What is defined in it may be used later.
  bool skip_value(std::string_view word, int depth) {
    Value ignored;
    if (word == "ROUTE" || word == "PROTO" || word == "EXTERNPROTO") return statement(word, "", depth, ignored);
    const std::string_view first = words_.peek();
    if (first == "[") return words_.next(), skip_to("]", depth);
    if (first == "DEF" || first == "USE") return statement(words_.next(), "", depth, ignored);
    VrmlWords ahead = words_;
    ahead.next();
    if (ahead.next() == "{") return words_ = ahead, skip_to("}", depth);
    const auto is_scalar = [](std::string_view w) {
      return w == "TRUE" || w == "FALSE" || w == "NULL" || w.starts_with("\"");
    };
    while (words_.number() || is_scalar(words_.peek()))
      if (is_scalar(words_.peek())) words_.next();
    return true;
  }

  /// Skips to the bracket or brace that ends what has begun.
  bool skip_to(std::string_view end, int depth) {
    std::vector<std::string_view> open{end};
    while (!open.empty()) {
      const std::string_view word = words_.next();
      if (word.empty()) return fail("it ends too early");
      if (open.size() + static_cast<std::size_t>(depth) > 100'000) return fail("nodes are nested too deep");
      if (word == "{") {
        open.push_back("}");
      } else if (word == "[") {
        open.push_back("]");
      } else if (word == "}" || word == "]") {
        if (open.back() != word) return fail("a bracket and a brace that do not match");
        open.pop_back();
      } else if (word == "DEF") {
        Value ignored;
        if (!statement(word, "", depth + 1, ignored)) return false;
      }
    }
    return true;
  }

  /// Remembers the name, and skips the rest.
  bool prototype(bool is_external) {
    prototypes_.insert(std::string(words_.next()));
    if (words_.next() != "[" || !words_.skip_past("[", "]")) return fail("a PROTO without an interface");
    const std::string_view word = words_.next();
    if (word == "[") return words_.skip_past("[", "]") || fail("it ends too early");
    if (is_external) return true;
    return (word == "{" && words_.skip_past("{", "}")) || fail("a PROTO without a body");
  }

  template <std::size_t kCount>
  bool numbers(std::array<double, kCount>& values) {
    for (double& value : values) {
      const std::optional<double> number = words_.number();
      if (!number) return fail(in_quotes(words_.peek()) + " is no finite number");
      value = *number;
    }
    return true;
  }

  bool add_scene_node(SceneNode node, Value& value) {
    value.kind = Value::Kind::Node;
    value.index = result_.scene.nodes.size();
    result_.scene.nodes.push_back(std::move(node));
    return true;
  }

  bool group(std::string_view type, const std::string& name, int depth, Value& value) {
    SceneNode result;
    result.name = name;
    std::array<double, 3> center{}, scale{1, 1, 1}, translation{};
    std::array<double, 4> rotation{}, orientation{};
    std::array<double, 1> choice{-1};
    std::vector<std::optional<std::size_t>> children;
    const auto read = [&](std::string_view field, bool& known) {
      known = true;
      if (field == "children" || field == "choice" || field == "level") return child_nodes(name, depth, children);
      if (field == "whichChoice") return numbers(choice);
      if (type != "Transform") return known = false, true;
      if (field == "translation") return numbers(translation);
      if (field == "scale") return numbers(scale);
      if (field == "center") return numbers(center);
      if (field == "rotation") return numbers(rotation);
      if (field == "scaleOrientation") return numbers(orientation);
      return known = false, true;
    };
    if (!fields(depth, read)) return false;
    const std::optional<SceneTransform> placement = vrml_transform({translation, rotation, scale, orientation, center});
    if (!placement) return fail("a rotation about an axis without direction");
    result.parent_from_node = *placement;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool is_shown = type == "Switch" ? choice[0] == static_cast<double>(i) : type != "LOD" || i == 0;
      if (is_shown && children[i]) result.children.push_back(*children[i]);
    }
    join_sheets(result.children, name);
    return add_scene_node(std::move(result), value);
  }

  /// Makes one node of the shapes without a name that are open: many programs write a shape for each face of a part, or
  /// for each colour.
  void join_sheets(std::vector<std::size_t>& siblings, const std::string& name) {
    std::vector<const SceneMesh*> parts;
    std::vector<std::size_t> others;
    for (const std::size_t sibling : siblings) {
      if (sheets_.contains(sibling)) {
        parts.push_back(&result_.meshes[*result_.scene.nodes[sibling].mesh]);
      } else {
        others.push_back(sibling);
      }
    }
    if (parts.size() < 2) return;
    SceneMesh whole = joined(parts);
    others.push_back(result_.scene.nodes.size());
    result_.scene.nodes.push_back({name, result_.meshes.size(), {}, {}});
    result_.meshes.push_back(std::move(whole));
    siblings = std::move(others);
  }

  /// One node, or several in brackets; none for what is not drawn.
  bool child_nodes(const std::string& name, int depth, std::vector<std::optional<std::size_t>>& children) {
    const auto one = [&](std::string_view word) {
      Value value;
      if (!statement(word, name, depth, value)) return false;
      children.push_back(value.kind == Value::Kind::Node ? std::optional(value.index) : std::nullopt);
      return true;
    };
    const std::string_view first = words_.next();
    if (first != "[") return one(first);
    for (std::string_view word = words_.next(); word != "]"; word = words_.next())
      if (!one(word)) return false;
    return true;
  }

  bool node_value(int depth, Value& value) { return statement(words_.next(), "", depth, value); }

  bool shape(const std::string& name, int depth, Value& value) {
    Value appearance, geometry;
    const auto read = [&](std::string_view field, bool& known) {
      known = true;
      if (field == "appearance") return node_value(depth, appearance);
      if (field == "geometry") return node_value(depth, geometry);
      return known = false, true;
    };
    if (!fields(depth, read)) return false;
    SceneNode result;
    result.name = name;
    if (geometry.kind == Value::Kind::Geometry) {
      result.mesh = result_.meshes.size();
      SceneMesh mesh{geometries_[geometry.index], {}};
      if (mesh.mesh.faces.size() > copied_left_) return fail("more triangles than the limit");
      copied_left_ -= mesh.mesh.faces.size();
      if (appearance.kind == Value::Kind::Color) mesh.color = appearance.color;
      if (!clean_mesh(mesh.mesh).faults.closed()) sheets_.insert(result_.scene.nodes.size());
      result_.meshes.push_back(std::move(mesh));
    }
    return add_scene_node(std::move(result), value);
  }

  bool colored(std::string_view field_with_color, int depth, Value& value) {
    return fields(depth, [&](std::string_view field, bool& known) {
      known = field == field_with_color;
      return !known || node_value(depth, value);
    });
  }

  bool material(int depth, Value& value) {
    std::array<double, 3> diffuse{0.8, 0.8, 0.8};
    const auto read = [&](std::string_view field, bool& known) {
      known = field == "diffuseColor";
      return !known || numbers(diffuse);
    };
    if (!fields(depth, read)) return false;
    const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(diffuse[i], 0.0, 1.0)); };
    value.kind = Value::Kind::Color;
    value.color = {channel(0), channel(1), channel(2), 1};
    return true;
  }

  bool coordinate(int depth, Value& value) {
    std::vector<Vec3> points;
    const auto read = [&](std::string_view field, bool& known) {
      known = field == "point";
      if (!known) return true;
      const bool is_list = words_.peek() == "[";
      if (is_list) words_.next();
      while (words_.peek() != "]") {
        std::array<double, 3> p{};
        if (!numbers(p)) return false;
        points.push_back({p[0], p[1], p[2]});
        if (!is_list) return true;
      }
      words_.next();
      return true;
    };
    if (!fields(depth, read)) return false;
    value.kind = Value::Kind::Points;
    value.index = points_.size();
    points_.push_back(std::move(points));
    return true;
  }

  bool face_set(int depth, Value& value) {
    Value points;
    std::vector<double> indices;
    bool counter_clockwise = true;
    const auto read = [&](std::string_view field, bool& known) {
      known = true;
      if (field == "coord") return node_value(depth, points);
      if (field == "coordIndex") return index_list(indices);
      if (field == "ccw") return counter_clockwise = words_.next() != "FALSE", true;
      return known = false, true;
    };
    if (!fields(depth, read)) return false;
    VrmlPolygons polygons;
    if (points.kind == Value::Kind::Points) polygons.vertices = points_[points.index];
    polygons.indices = std::move(indices);
    polygons.is_counter_clockwise = counter_clockwise;
    std::optional<TriangleMesh> mesh = vrml_mesh(std::move(polygons), triangles_left_);
    if (!mesh) return fail("an index of a polygon is out of range, or more triangles than the limit");
    return add_geometry(std::move(*mesh), value);
  }

  bool index_list(std::vector<double>& indices) {
    const bool is_list = words_.peek() == "[";
    if (is_list) words_.next();
    while (const std::optional<double> index = words_.number()) {
      indices.push_back(std::trunc(*index));
      if (!is_list) return true;
    }
    return words_.next() == "]" ? true : fail("an index that is no number");
  }

  bool add_geometry(TriangleMesh mesh, Value& value) {
    if (mesh.faces.size() > triangles_left_) return fail("more triangles than the limit");
    triangles_left_ -= mesh.faces.size();
    value.kind = Value::Kind::Geometry;
    value.index = geometries_.size();
    geometries_.push_back(std::move(mesh));
    return true;
  }

  bool solid(std::string_view type, Value& value) {
    std::array<double, 3> size{2, 2, 2};
    std::array<double, 1> radius{1}, height{2};
    const auto read = [&](std::string_view field, bool& known) {
      known = true;
      if (field == "size") return numbers(size);
      if (field == "radius" || field == "bottomRadius") return numbers(radius);
      if (field == "height") return numbers(height);
      return known = false, true;
    };
    if (!fields(0, read)) return false;
    if (!(size[0] > 0 && size[1] > 0 && size[2] > 0 && radius[0] > 0 && height[0] > 0))
      return fail("a shape of no size");
    TessellatedShape shape = vrml_solid(type, {size[0], size[1], size[2]}, radius[0], height[0]);
    result_.deflection = std::max(result_.deflection, shape.deflection);
    return add_geometry(std::move(shape.mesh), value);
  }

  const MeshSource& source_;
  VrmlWords words_;
  std::size_t triangles_left_, copied_left_;
  VrmlScene result_;
  std::vector<TriangleMesh> geometries_;
  std::vector<std::vector<Vec3>> points_;
  std::map<std::string, Value> defined_;  // a node within itself is not there yet
  std::set<std::string> prototypes_;
  std::set<std::size_t> sheets_;  // shapes without a name that are open, by node
  std::optional<Error> error_;
};

}  // namespace

Result<VrmlScene> parse_vrml(const MeshSource& source, std::size_t triangle_limit) {
  const std::string_view head = source.bytes.substr(0, 256);
  if (head.find("#VRML V1.0") != std::string_view::npos)
    return malformed(source, "VRML", "it is VRML 1.0, not 2.0 (VRML97)");
  if (head.find("#VRML V2.0 utf8") == std::string_view::npos)
    return malformed(source, "VRML", "it does not begin with #VRML V2.0 utf8");
  return VrmlParser(source, triangle_limit).parse();
}

}  // namespace dismantle
