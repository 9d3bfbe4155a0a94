// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/result_table.h"

#include "dismantle/core/contract.h"

#include <fstream>

namespace dismantle {

namespace {

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    DISMANTLE_EXPECT(cell.find_first_of(",\"\n") == std::string::npos);
    line += (&cell == cells.data() ? "" : ",") + cell;
  }
  return line + "\n";
}

}  // namespace

std::string csv_of(const ResultTable& table) {
  std::string text = csv_line(table.columns);
  for (const std::vector<std::string>& row : table.rows) text += csv_line(row);
  return text;
}

bool write_result(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path part = file.string() + ".part";
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) return false;
  std::filesystem::rename(part, file, failed);
  return !failed;
}

}  // namespace dismantle
