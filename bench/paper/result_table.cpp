// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/result_table.h"

#include "dismantle/core/contract.h"
#include "dismantle/files/csv_text.h"

#include <algorithm>

namespace dismantle {

namespace {

std::string csv_line(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = csv_field(cell);
  return joined(cells, ",") + "\n";
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

}  // namespace

std::string csv_of(const ResultTable& table) {
  std::string text = csv_line(table.columns);
  for (const std::vector<std::string>& row : table.rows) text += csv_line(row);
  return text;
}

std::string markdown_of(const ResultTable& table) {
  std::string text = markdown_row(table.columns);
  text += markdown_row(std::vector<std::string>(table.columns.size(), "---"));
  for (const std::vector<std::string>& row : table.rows) text += markdown_row(row);
  return text;
}

ResultTable columns_of(const ResultTable& table, const std::vector<std::string>& names) {
  ResultTable chosen{names, std::vector<std::vector<std::string>>(table.rows.size())};
  for (const std::string& name : names) {
    const auto column = std::find(table.columns.begin(), table.columns.end(), name);
    DISMANTLE_EXPECT(column != table.columns.end());
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      chosen.rows[r].push_back(table.rows[r][static_cast<std::size_t>(column - table.columns.begin())]);
  }
  return chosen;
}

}  // namespace dismantle
