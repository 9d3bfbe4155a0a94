// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/freecad/freecad_scene.h"

#include "dismantle/files/text_name.h"
#include "dismantle/formats/cad/brep_shape.h"
#include "dismantle/formats/cad/cad_model.h"
#include "dismantle/formats/cad/freecad_archives.h"

#include <TopLoc_Location.hxx>
#include <cmath>
#include <optional>
#include <utility>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// The largest deviation of a placement from a scaled rotation, relative to its scale: rounding.
constexpr double kScaleTolerance = 1e-9;

Error unreadable(const std::string& problem) {
  return {ErrorKind::Unreadable, problem};
}

/// The transform of a placement; none if it scales differently along its axes.
std::optional<gp_Trsf> transform_of(const SceneTransform& placement) {
  const Mat3 gram = transposed(placement.linear) * placement.linear;
  const double square = (gram.row[0].x + gram.row[1].y + gram.row[2].z) / 3;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(gram.row[i][k] - (i == k ? square : 0)) <= kScaleTolerance * square)) return std::nullopt;
  if (!(square > 0)) return std::nullopt;
  const Vec3 &a = placement.linear.row[0], &b = placement.linear.row[1], &c = placement.linear.row[2];
  const Vec3& t = placement.translation;
  gp_Trsf transform;
  transform.SetValues(a.x, a.y, a.z, t.x, b.x, b.y, b.z, t.y, c.x, c.y, c.z, t.z);
  return transform;
}

class SceneWalker {
 public:
  SceneWalker(const FreeCadScene& scene, FreeCadArchives& archives, const ImportOptions& options)
      : scene_(scene),
        archives_(archives),
        options_(options),
        tree_(options.solids, LooseFaces::ByShell, options.limits.components),
        products_(scene.shapes.size()) {}

  Result<CadProductTree> walk(const std::string& root_name) {
    tree_.add_node(root_name, 0);
    for (const std::size_t root : scene_.scene.roots)
      if (const Result<Done> visited = visit(root, {}, 0); !visited) return visited.error();
    return tree_.finish();
  }

 private:
  Result<Done> visit(std::size_t index, const SceneTransform& outer, std::uint32_t parent) {
    if (tree_.is_too_large()) return Done{};
    const SceneNode& node = scene_.scene.nodes[index];
    const SceneTransform placement = outer * node.parent_from_node;
    const std::uint32_t tree_node = tree_.add_node(node.name, parent);
    if (node.mesh) {
      const Result<std::uint32_t> product = product_of(*node.mesh, node.name);
      if (!product) return product.error();
      const std::optional<gp_Trsf> transform = transform_of(placement);
      if (!transform)
        return unreadable("its object " + in_quotes(node.name) +
                          " is scaled differently along its axes; scale its shape instead");
      CadOccurrence occurrence;
      occurrence.name = node.name;
      occurrence.product = *product;
      occurrence.tree_node = tree_node;
      occurrence.placement = *transform;
      tree_.add_occurrences(occurrence);
    }
    for (const std::size_t child : node.children)
      if (const Result<Done> visited = visit(child, placement, tree_node); !visited) return visited.error();
    return Done{};
  }

  Result<std::uint32_t> product_of(std::size_t index, const std::string& label) {
    std::optional<std::uint32_t>& product = products_[index];
    if (product) return *product;
    const FreeCadShape& shape = scene_.shapes[index];
    report_progress(options_.progress, "reading", static_cast<double>(index) / static_cast<double>(products_.size()));
    const Result<std::string> bytes = archives_.read(shape.file, shape.entry);
    if (!bytes) return bytes.error();
    TopoDS_Shape read;
    if (!bytes->empty()) {  // a feature without a result
      read = read_brep_shape(*bytes, {});
      if (read.IsNull())
        return unreadable("the shape of its object " + in_quotes(label) + " breaks the grammar of BREP; save it again");
      read.Location(TopLoc_Location());  // the object's placement, which the scene has
    }
    CadProduct colors;
    colors.color = shape.color;
    product = tree_.add_product(read, std::move(colors));
    return *product;
  }

  const FreeCadScene& scene_;
  FreeCadArchives& archives_;
  const ImportOptions& options_;
  ProductTreeBuilder tree_;
  std::vector<std::optional<std::uint32_t>> products_;  // by shape
};

}  // namespace

Result<CadModel> read_freecad_model(const CadSource& source, const ImportOptions& options) {
  FreeCadArchives archives(source, options);
  const FreeCadEntryReader read = [&](const fs::path& file, const std::string& entry) {
    return archives.read(file, entry);
  };
  const Result<FreeCadScene> scene = read_freecad_scene(archives.root(), read);
  if (!scene) return scene.error();
  Result<CadProductTree> products = SceneWalker(*scene, archives, options).walk(source.name());
  if (!products) return products.error();
  CadModel model;
  model.products = std::move(*products);
  model.linked_files = archives.linked_files();
  return model;
}

}  // namespace dismantle
