// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace dismantle {

/// Rows of text under named columns, as they are printed, written as CSV and shown on a page.
struct ResultTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< Each as long as `columns`.
};

/// Lines of comma-separated values, the columns' names first; values that need it are quoted (RFC 4180).
std::string csv_of(const ResultTable& table);
/// Lines of a Markdown table.
std::string markdown_of(const ResultTable& table);
/// Only these columns, in this order. @pre the table has them
ResultTable columns_of(const ResultTable& table, const std::vector<std::string>& names);

}  // namespace dismantle
