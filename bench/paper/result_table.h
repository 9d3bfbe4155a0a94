// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dismantle {

/// Rows of text under named columns, for printing, CSV and Markdown.
struct ResultTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< Each as long as `columns`.
};

/// CSV with a header line; values are quoted where needed (RFC 4180).
std::string csv_of(const ResultTable& table);
/// A Markdown table.
std::string markdown_of(const ResultTable& table);
/// Only these columns, in this order. @pre the table has them
ResultTable columns_of(const ResultTable& table, const std::vector<std::string>& names);

}  // namespace dismantle
