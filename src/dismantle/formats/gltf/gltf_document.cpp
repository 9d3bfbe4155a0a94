// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_document.h"

#include "dismantle/files/json_node.h"
#include "dismantle/formats/import/mesh_source.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

/// Extensions that a file may require and that are ignored: they change the appearance, not the shape. The last one
/// only allows positions of all types, which this reader accepts.
constexpr std::string_view kHarmlessPrefixes[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"};
constexpr std::string_view kKnownExtension = "KHR_mesh_quantization";
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

float srgb_from_linear(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

class DocumentReader {
 public:
  explicit DocumentReader(const std::string& file_name) : file_name_(file_name), in_(file_name) {}

  Result<GltfDocument> read(const nlohmann::json& json) {
    const JsonNode root{&json, nullptr, {}, 0};
    if (const Result<Done> checked = check_version_and_extensions(root); !checked) return checked.error();
    each(root, "buffers", [&](const JsonNode& node) { document_.buffers.push_back(buffer(node)); });
    each(root, "bufferViews", [&](const JsonNode& node) { document_.views.push_back(view(node)); });
    each(root, "accessors", [&](const JsonNode& node) { document_.accessors.push_back(accessor(node)); });
    each(root, "materials", [&](const JsonNode& node) { document_.materials.push_back(material(node)); });
    each(root, "meshes", [&](const JsonNode& node) { document_.meshes.push_back(mesh(node)); });
    const JsonNode nodes = in_.optional_member(root, "nodes");
    const std::size_t node_count = nodes.json ? in_.size(nodes) : 0;
    each(root, "nodes", [&](const JsonNode& n) { document_.nodes.push_back(node(n, node_count)); });
    find_roots(root);
    if (!in_.ok()) return *in_.error();
    return std::move(document_);
  }

 private:
  template <class Take>
  void each(const JsonNode& object, std::string_view name, Take take) {
    const JsonNode array = in_.optional_member(object, name);
    if (!in_.ok() || array.json == nullptr) return;
    const std::size_t count = in_.size(array);
    for (std::size_t i = 0; i < count && in_.ok(); ++i) take(array.at(i));
  }

  Result<Done> check_version_and_extensions(const JsonNode& root) {
    const JsonNode asset = in_.member(root, "asset");
    if (!in_.ok()) return *in_.error();
    const JsonNode version = in_.member(asset, "version");
    const std::string text = in_.ok() ? in_.text(version) : "";
    if (in_.ok() && text.substr(0, 2) != "2.")
      in_.fail(version, "glTF " + in_quotes(text) + ", but dismantle reads glTF 2");
    std::optional<std::string> unknown;
    each(root, "extensionsRequired", [&](const JsonNode& node) {
      const std::string name = in_.text(node);
      const bool known = name == kKnownExtension ||
                         std::any_of(std::begin(kHarmlessPrefixes), std::end(kHarmlessPrefixes),
                                     [&](std::string_view prefix) { return name.substr(0, prefix.size()) == prefix; });
      if (!known && !unknown) unknown = name;
    });
    if (!in_.ok()) return *in_.error();
    if (unknown) return needs_extension(*unknown);
    return Done{};
  }

  Error needs_extension(std::string_view name) const {
    return {ErrorKind::Unreadable, file_name_ + " cannot be used (it needs the glTF extension " + in_quotes(name) +
                                       ", which dismantle does not know); export it again without"};
  }

  std::size_t whole_number(const JsonNode& node) {
    if (!in_.ok()) return 0;
    if (node.json->is_number_unsigned()) return node.json->get<std::size_t>();
    in_.fail(node, "not a whole number");
    return 0;
  }
  std::size_t whole_number(const JsonNode& object, std::string_view name, std::size_t otherwise) {
    const JsonNode node = in_.optional_member(object, name);
    return in_.ok() && node.json ? whole_number(node) : otherwise;
  }
  std::size_t index(const JsonNode& node, std::size_t count) {
    const std::size_t i = whole_number(node);
    if (in_.ok() && i >= count) in_.fail(node, "there is no such one");
    return i;
  }
  std::optional<std::size_t> optional_index(const JsonNode& object, std::string_view name, std::size_t count) {
    const JsonNode node = in_.optional_member(object, name);
    if (!in_.ok() || node.json == nullptr) return std::nullopt;
    return index(node, count);
  }
  std::string optional_text(const JsonNode& object, std::string_view name) {
    const JsonNode node = in_.optional_member(object, name);
    return in_.ok() && node.json ? in_.text(node) : "";
  }
  /// The numbers of an optional member of fixed size.
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(const JsonNode& object, std::string_view name) {
    const JsonNode node = in_.optional_member(object, name);
    if (!in_.ok() || node.json == nullptr) return std::nullopt;
    std::array<double, N> values{};
    if (in_.size(node) != N && in_.ok()) in_.fail(node, "not " + std::to_string(N) + " numbers");
    for (std::size_t i = 0; i < N && in_.ok(); ++i) values[i] = in_.number(node.at(i));
    return values;
  }

  GltfScalar scalar(const JsonNode& object) {
    const JsonNode node = in_.member(object, "componentType");
    const std::size_t number = whole_number(node);
    for (const GltfScalar known : {GltfScalar::Int8, GltfScalar::UInt8, GltfScalar::Int16, GltfScalar::UInt16,
                                   GltfScalar::UInt32, GltfScalar::Float32})
      if (number == static_cast<std::size_t>(known)) return known;
    in_.fail(node, "no type that glTF knows");
    return GltfScalar::Float32;
  }

  GltfBuffer buffer(const JsonNode& node) {
    GltfBuffer b;
    b.length = whole_number(in_.member(node, "byteLength"));
    const JsonNode uri = in_.optional_member(node, "uri");
    if (in_.ok() && uri.json) b.uri = in_.text(uri);
    return b;
  }

  GltfView view(const JsonNode& node) {
    GltfView v;
    v.buffer = index(in_.member(node, "buffer"), document_.buffers.size());
    v.offset = whole_number(node, "byteOffset", 0);
    v.length = whole_number(in_.member(node, "byteLength"));
    v.stride = whole_number(node, "byteStride", 0);
    return v;
  }

  GltfAccessor accessor(const JsonNode& node) {
    GltfAccessor a;
    a.view = optional_index(node, "bufferView", document_.views.size());
    a.offset = whole_number(node, "byteOffset", 0);
    a.count = whole_number(in_.member(node, "count"));
    a.scalar = scalar(node);
    const JsonNode type = in_.member(node, "type");
    const std::string name = in_.ok() ? in_.text(type) : "";
    a.width = name == "SCALAR" ? 1 : (name == "VEC3" ? 3 : 0);
    const JsonNode normalized = in_.optional_member(node, "normalized");
    a.normalized = in_.ok() && normalized.json && normalized.json->is_boolean() && normalized.json->get<bool>();
    const JsonNode sparse_node = in_.optional_member(node, "sparse");
    if (in_.ok() && sparse_node.json) a.sparse = sparse(sparse_node);
    return a;
  }

  GltfSparse sparse(const JsonNode& node) {
    GltfSparse s;
    s.count = whole_number(in_.member(node, "count"));
    const JsonNode indices = in_.member(node, "indices");
    const JsonNode values = in_.member(node, "values");
    if (!in_.ok()) return s;
    s.index_view = index(in_.member(indices, "bufferView"), document_.views.size());
    s.index_offset = whole_number(indices, "byteOffset", 0);
    s.index_scalar = scalar(indices);
    s.value_view = index(in_.member(values, "bufferView"), document_.views.size());
    s.value_offset = whole_number(values, "byteOffset", 0);
    return s;
  }

  Color material(const JsonNode& node) {
    const JsonNode surface = in_.optional_member(node, "pbrMetallicRoughness");
    std::array<double, 4> factor{1, 1, 1, 1};
    if (in_.ok() && surface.json) factor = numbers<4>(surface, "baseColorFactor").value_or(factor);
    const std::string alpha = optional_text(node, "alphaMode");
    return {srgb_from_linear(factor[0]), srgb_from_linear(factor[1]), srgb_from_linear(factor[2]),
            alpha == "BLEND" ? static_cast<float>(std::clamp(factor[3], 0.0, 1.0)) : 1.0f};
  }

  GltfMesh mesh(const JsonNode& node) {
    GltfMesh m;
    m.name = optional_text(node, "name");
    each(node, "primitives", [&](const JsonNode& p) {
      if (const auto read = primitive(p)) m.primitives.push_back(*read);
    });
    return m;
  }

  /// None if it has no triangles.
  std::optional<GltfPrimitive> primitive(const JsonNode& node) {
    GltfPrimitive p;
    const std::size_t mode = whole_number(node, "mode", static_cast<std::size_t>(GltfMode::Triangles));
    if (mode < 4 || mode > 6) return std::nullopt;
    p.mode = static_cast<GltfMode>(mode);
    const JsonNode attributes = in_.member(node, "attributes");
    if (!in_.ok()) return std::nullopt;
    const JsonNode position = in_.optional_member(attributes, "POSITION");
    if (!in_.ok() || position.json == nullptr) return std::nullopt;
    p.positions = index(position, document_.accessors.size());
    p.indices = optional_index(node, "indices", document_.accessors.size());
    p.material = optional_index(node, "material", document_.materials.size());
    const JsonNode extensions = in_.optional_member(node, "extensions");
    if (!in_.ok()) return std::nullopt;
    if (extensions.json && extensions.json->contains(kDraco) && !document_.accessors[p.positions].view)
      in_.fail(node, "compressed with " + std::string(kDraco) + ", which dismantle does not know");
    check_types(node, p);
    return p;
  }

  void check_types(const JsonNode& node, const GltfPrimitive& p) {
    if (!in_.ok()) return;
    if (document_.accessors[p.positions].width != 3) in_.fail(node, "its positions are no vectors of three");
    if (!p.indices) return;
    const GltfAccessor& indices = document_.accessors[*p.indices];
    if (indices.width != 1 || indices.scalar == GltfScalar::Float32) in_.fail(node, "its indices are no whole numbers");
  }

  SceneNode node(const JsonNode& node, std::size_t node_count) {
    SceneNode n;
    n.name = optional_text(node, "name");
    n.mesh = optional_index(node, "mesh", document_.meshes.size());
    n.parent_from_node = transform(node);
    each(node, "children", [&](const JsonNode& child) { n.children.push_back(index(child, node_count)); });
    return n;
  }

  SceneTransform transform(const JsonNode& node) {
    if (const auto m = numbers<16>(node, "matrix"))  // by columns
      return {{{{(*m)[0], (*m)[4], (*m)[8]}, {(*m)[1], (*m)[5], (*m)[9]}, {(*m)[2], (*m)[6], (*m)[10]}}},
              {(*m)[12], (*m)[13], (*m)[14]}};
    const auto t = numbers<3>(node, "translation").value_or(std::array<double, 3>{0, 0, 0});
    const auto r = numbers<4>(node, "rotation").value_or(std::array<double, 4>{0, 0, 0, 1});  // x, y, z, w
    const auto s = numbers<3>(node, "scale").value_or(std::array<double, 3>{1, 1, 1});
    const Mat3 scale{{{s[0], 0, 0}, {0, s[1], 0}, {0, 0, s[2]}}};
    return {mat3_from_quat(normalized(Quat{r[3], r[0], r[1], r[2]})) * scale, {t[0], t[1], t[2]}};
  }

  void find_roots(const JsonNode& root) {
    if (!in_.ok()) return;
    std::vector<bool> has_parent(document_.nodes.size(), false);
    const JsonNode nodes = in_.optional_member(root, "nodes");
    for (std::size_t i = 0; i < document_.nodes.size(); ++i)
      for (const std::size_t child : document_.nodes[i].children) {
        if (has_parent[child]) return in_.fail(nodes.at(child), "it has two parents");
        has_parent[child] = true;
      }

    const std::optional<std::size_t> scene = default_scene(root);
    if (!in_.ok()) return;
    if (!scene) {
      for (std::size_t i = 0; i < document_.nodes.size(); ++i)
        if (!has_parent[i]) document_.roots.push_back(i);
      return;
    }
    const JsonNode scenes = in_.member(root, "scenes");
    const JsonNode chosen = scenes.at(*scene);
    std::vector<bool> taken(document_.nodes.size(), false);
    each(chosen, "nodes", [&](const JsonNode& node) {
      const std::size_t i = index(node, document_.nodes.size());
      if (!in_.ok()) return;
      if (has_parent[i] || taken[i]) return in_.fail(node, "not a root, or twice");
      taken[i] = true;
      document_.roots.push_back(i);
    });
  }

  std::optional<std::size_t> default_scene(const JsonNode& root) {
    const JsonNode scenes = in_.optional_member(root, "scenes");
    const std::size_t count = in_.ok() && scenes.json ? in_.size(scenes) : 0;
    if (!in_.ok() || count == 0) return std::nullopt;
    const std::optional<std::size_t> scene = optional_index(root, "scene", count);
    return scene ? scene : std::optional<std::size_t>(0);
  }

  std::string file_name_;
  JsonReader in_;
  GltfDocument document_;
};

}  // namespace

std::size_t byte_size(GltfScalar scalar) {
  switch (scalar) {
    case GltfScalar::Int8:
    case GltfScalar::UInt8:
      return 1;
    case GltfScalar::Int16:
    case GltfScalar::UInt16:
      return 2;
    default:
      return 4;
  }
}

Result<GltfDocument> parse_gltf(std::string_view text, const std::string& file_name) {
  const Result<nlohmann::json> json = parse_json(text, file_name);
  if (!json) return json.error();
  return DocumentReader(file_name).read(*json);
}

}  // namespace dismantle
