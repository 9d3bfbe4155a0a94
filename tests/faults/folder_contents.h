// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace dismantle::faults {

/// Files by their path below a folder; symbolic links, too, with what they point to.
using FolderContents = std::map<std::string, std::string>;

/// Everything below a folder; empty if there is none.
FolderContents contents_of(const std::filesystem::path& folder);

/// Makes the folder contain exactly these files.
void restore(const std::filesystem::path& folder, const FolderContents& contents);

/// A file name in which every run of digits is replaced by N, so that names with process ids are equal.
std::string without_digits(const std::string& name);

}  // namespace dismantle::faults
