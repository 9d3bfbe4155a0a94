// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "samples/generator/solid.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle::samples {

/// sRGB in [0, 1].
struct Paint {
  double r = 0.7, g = 0.7, b = 0.7;
};

/// The paints that the samples share, so that like parts look alike.
inline constexpr Paint kSteel{0.66, 0.68, 0.71}, kBrightSteel{0.82, 0.83, 0.85}, kBlackOxide{0.17, 0.17, 0.19},
    kBrass{0.80, 0.64, 0.28}, kBronze{0.66, 0.46, 0.24}, kAluminium{0.78, 0.80, 0.82}, kRubber{0.10, 0.10, 0.11},
    kGlass{0.62, 0.82, 0.88}, kCream{0.90, 0.87, 0.78}, kMachineGreen{0.33, 0.47, 0.42}, kOrange{0.93, 0.45, 0.12},
    kDarkGrey{0.30, 0.31, 0.33}, kRed{0.75, 0.16, 0.14}, kBlue{0.20, 0.36, 0.62}, kToolSteel{0.55, 0.57, 0.62};

/// A product: one solid with a name and a paint; instances of it share the solid.
struct ProductId {
  int index = -1;
};
/// A sub-assembly of the product tree.
struct GroupId {
  int index = -1;
};

/// One placed component of a sample.
struct Occurrence {
  std::string name;  ///< As dismantle names it: the product's name, a repeat with #2, #3, ... in file order.
  int product = 0;
  Placement placement;
};

/// An assembly under construction: products, groups (one level below the root), and instances.
class SampleModel {
 public:
  explicit SampleModel(std::string name);

  ProductId product(const std::string& name, const Solid& solid, const Paint& paint);
  GroupId group(const std::string& name);
  void place(GroupId group, ProductId product, const Placement& placement = Placement());
  void place_all(GroupId group, ProductId product, const std::vector<Placement>& placements);
  /// A product that occurs once.
  void add(GroupId group, const std::string& name, const Solid& solid, const Paint& paint,
           const Placement& placement = Placement());

  const std::string& name() const { return name_; }
  /// In file order: group by group, each in the order of placing.
  std::vector<Occurrence> occurrences() const;
  const Solid& solid(int product) const { return products_[static_cast<std::size_t>(product)].solid; }
  const Paint& paint(int product) const { return products_[static_cast<std::size_t>(product)].paint; }
  /// Writes STEP AP214 with names, colours, tree and shared instances; the same structure and numbers every time, with
  /// no clock in it (the order of a few style entities is OpenCASCADE's).
  /// Throws std::runtime_error where the file cannot be written.
  void write_step(const std::filesystem::path& file) const;

 private:
  struct Product {
    std::string name;
    Solid solid;
    Paint paint;
  };
  struct Instance {
    int product;
    Placement placement;
  };
  struct Group {
    std::string name;
    std::vector<Instance> instances;
  };
  std::string name_;
  std::vector<Product> products_;
  std::vector<Group> groups_;
};

}  // namespace dismantle::samples
