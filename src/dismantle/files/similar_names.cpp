// SPDX-License-Identifier: Apache-2.0
#include "dismantle/files/similar_names.h"

#include "dismantle/files/text_scan.h"

#include <algorithm>
#include <tuple>

namespace dismantle {

namespace {

/// Longer texts are not compared letter by letter, which takes the product of their lengths.
constexpr std::size_t kMaxLength = 200;
/// Shorter texts are not compared with the beginnings of names: too many begin alike.
constexpr std::size_t kMinBeginning = 5;

/// Number of letters to insert, delete, replace or exchange with their neighbour to make one text of the other
/// (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::vector<std::string> similar_names(std::string_view typed, Span<const std::string> names, std::size_t max_count) {
  const std::string wanted = lower_case(typed);
  if (wanted.empty() || wanted.size() > kMaxLength) return {};
  const std::size_t max_edits = std::max<std::size_t>(1, wanted.size() / 4);
  // Names that contain the text come first, the shortest first; then by the number of edits; then those that only begin
  // like the text. Ties are in the order given.
  std::vector<std::tuple<int, std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(names[i]);
    const std::size_t longer = std::max(name.size(), wanted.size()) - std::min(name.size(), wanted.size());
    if (name.find(wanted) != std::string::npos) {
      found.emplace_back(0, name.size(), i);
    } else if (const std::size_t edits = longer <= max_edits ? edit_distance(wanted, name) : max_edits + 1;
               edits <= max_edits) {
      found.emplace_back(1, edits, i);
    } else if (wanted.size() >= kMinBeginning && name.size() > wanted.size()) {
      const std::size_t begins = edit_distance(wanted, std::string_view(name).substr(0, wanted.size()));
      if (begins <= max_edits) found.emplace_back(2, begins, i);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> similar;
  for (std::size_t i = 0; i < std::min(max_count, found.size()); ++i) similar.push_back(names[std::get<2>(found[i])]);
  return similar;
}

std::string did_you_mean(std::string_view typed, Span<const std::string> names) {
  const std::vector<std::string> similar = similar_names(typed, names);
  std::string text;
  for (std::size_t i = 0; i < similar.size(); ++i) {
    text += i == 0 ? "; did you mean " : i + 1 < similar.size() ? ", " : " or ";
    text += "'" + similar[i] + "'";
  }
  return text.empty() ? text : text + "?";
}

}  // namespace dismantle
