// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/formats/import/import_options.h"

#include <NCollection_DataMap.hxx>
#include <TopTools_OrientedShapeMapHasher.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>
#include <cstdint>
#include <gp_Trsf.hxx>
#include <optional>
#include <string>
#include <vector>

namespace dismantle {

/// The colours of a product with shapes, and of its sub-shapes.
struct CadProduct {
  std::optional<Color> color;
  NCollection_DataMap<TopoDS_Shape, Color, TopTools_ShapeMapHasher> subshape_colors;  ///< Keys: without location.
};

/// One occurrence of a solid (or of a product's shapes without solids) in the assembled state.
struct CadOccurrence {
  std::string name;
  std::uint32_t shape = 0;               ///< Index into CadProductTree::shapes.
  std::uint32_t product = 0;             ///< Index into CadProductTree::products.
  std::uint32_t tree_node = 0;           ///< Index into CadProductTree::tree.
  gp_Trsf placement;                     ///< assembly_from_shape, perhaps with a scale or a mirroring
  std::optional<Color> instance_color;   ///< Of this occurrence: overrides the product's colours.
  std::optional<Color> inherited_color;  ///< Of an enclosing assembly: used if there is no other.
};

/// The products of a CAD file and their occurrences, not meshed.
struct CadProductTree {
  std::vector<TopoDS_Shape> shapes;  ///< Distinct, without location.
  std::vector<CadProduct> products;
  std::vector<CadOccurrence> occurrences;  ///< In the order of the file.
  std::vector<TreeNode> tree;              ///< Node 0 is the root.
};

/// What becomes of the faces of a product outside its solids.
enum class LooseFaces {
  Together,  ///< One component.
  ByShell,   ///< A component of each shell; one of the faces outside shells.
};

/// Builds a CadProductTree. Each solid of a product is an occurrence, and what LooseFaces makes of its other faces;
/// with Solids::Join, they are one occurrence together.
class ProductTreeBuilder {
 public:
  /// @param limit largest number of occurrences; of tree nodes, a few times as many
  ProductTreeBuilder(Solids solids, LooseFaces loose_faces, std::size_t limit)
      : solids_(solids), loose_faces_(loose_faces), limit_(limit) {}

  /// Appends a node; the first is the root, and its own parent. @return its index
  std::uint32_t add_node(const std::string& name, std::uint32_t parent);
  /// Appends a product. @return its index
  std::uint32_t add_product(const TopoDS_Shape& shape, CadProduct product);
  /// Appends the occurrences of the product's pieces, for an occurrence of the whole product: `shape` is ignored, and a
  /// product of several pieces gets a node for each below `tree_node`.
  void add_occurrences(const CadOccurrence& whole);
  /// True once the limit is exceeded: what is added then is not looked at.
  bool is_too_large() const { return too_large_; }
  /// Refuses the tree: it is nested endlessly.
  void refuse() { too_large_ = true; }

  /// The tree. Errors: Unreadable if it is too large.
  Result<CadProductTree> finish();

 private:
  /// One solid (or other piece) of a product, and its placement in the product.
  struct Piece {
    std::uint32_t shape;
    gp_Trsf product_from_shape;
  };

  Piece piece_of(const TopoDS_Shape& shape);

  Solids solids_;
  LooseFaces loose_faces_;
  std::size_t limit_;
  bool too_large_ = false;
  CadProductTree result_;
  std::vector<std::vector<Piece>> pieces_;  // by product
  NCollection_DataMap<TopoDS_Shape, std::uint32_t, TopTools_OrientedShapeMapHasher> shape_index_;
};

}  // namespace dismantle
