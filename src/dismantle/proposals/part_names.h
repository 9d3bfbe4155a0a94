// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

/// The words of a name, in lower case: at other characters than letters and digits, and where a capital follows a small
/// letter, a word ends.
std::vector<std::string> words_of(std::string_view name);

/// What a purchased part is called, by a word of its name: "bearing", "motor", "connector"; empty where none is known,
/// or another word says that it only belongs to one ("motor mount").
std::string purchased_word(std::string_view name);

/// The bearing of which a component is a ring, a cage or a rolling element by its name: "front bearing" for "Front
/// bearing roller#2"; empty where the name says nothing of the kind.
std::string bearing_of(std::string_view name);

/// What a part that gives is called, by words of its name: "o-ring", "circlip", "cable"; empty where none is known, or
/// another word says that it only belongs to one ("cable cover").
std::string flexible_word(std::string_view name);

}  // namespace dismantle
