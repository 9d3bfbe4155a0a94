// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dismantle {

/// Rows of text under named columns.
struct ResultTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< Each as long as `columns`.
};

/// CSV with a header line. @pre no value has a comma, a quote or a line break
std::string csv_of(const ResultTable& table);

/// Writes a text to a file by way of another one, so that no half of it is ever there. @return false where it cannot
bool write_result(const std::filesystem::path& file, const std::string& text);

}  // namespace dismantle
