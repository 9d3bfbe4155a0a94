// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/documents/bill_of_materials.h"

#include <functional>
#include <string>
#include <vector>

namespace dismantle {

/// The characters of a text that a document cannot show; FontCoverage::missing for a PDF. Empty: it shows all.
using MissingGlyphs = std::function<std::string(const std::string&)>;

/// How components and items of the parts list are called in work instructions. Long names, and names with characters
/// that the document cannot show, are replaced by the number of the item: "item 7". Where several items have one name,
/// the number is added in running text: "part (item 7)".
class InstructionNames {
 public:
  /// The assembly and the bill must outlive this. The bill has a line for every component.
  InstructionNames(const Assembly& assembly, const std::vector<BillItem>& bill, const MissingGlyphs& missing_glyphs);

  /// A component in running text: its name, "item 7", or both.
  std::string of(ComponentId c) const;
  /// A component in a title, where a long name is shortened: "a long na... (item 7)".
  std::string in_title(ComponentId c) const;
  /// As of(), for all components of an item, from 0.
  std::string of_item(std::size_t item) const;
  /// As in_title(), for all components of an item.
  std::string item_in_title(std::size_t item) const;
  /// The name in the parts list: complete, or "item 7" where it cannot be shown.
  std::string in_list(std::size_t item) const;
  /// The name of a sub-assembly in a title, shortened; empty where it cannot be shown.
  std::string of_body(const std::string& name) const;
  /// All characters of names that cannot be shown, each once.
  const std::string& missing() const { return missing_; }

 private:
  bool can_show(const std::string& name) const;
  std::string in_text(const std::string& name, std::size_t item) const;

  const Assembly& assembly_;
  const std::vector<BillItem>& bill_;
  std::vector<std::size_t> items_;  // of each component
  std::vector<bool> is_ambiguous_;  // of each item: another one has its name
  MissingGlyphs missing_glyphs_;
  std::string missing_;
};

/// "a, b and c"; a long list ends with "and 3 more".
std::string list_text(const std::vector<std::string>& names);

}  // namespace dismantle
