// SPDX-License-Identifier: Apache-2.0
#include "dismantle/proposals/part_names.h"

#include <algorithm>
#include <cctype>

namespace dismantle {

namespace {

/// Words of what is bought as one part. Where a word ends with "*", any that begins so; a blank separates two words
/// that follow each other.
constexpr std::string_view kPurchased[] = {
    "bearing*",   "motor*",    "gearmotor*", "servo*", "stepper*", "nema*",         "gearbox",      "connector*",
    "header",     "jst*",      "usb*",       "hdmi*",  "rj45",     "switch*",       "microswitch*", "pcb*",
    "board",      "arduino*",  "raspberry",  "esp32*", "esp8266*", "nucleo*",       "xiao*",        "module",
    "sensor*",    "encoder*",  "relay*",     "fan",    "blower",   "display",       "lcd*",         "oled*",
    "battery",    "camera",    "solenoid*",  "psu",    "lidar",    "gps",           "speaker",      "buzzer",
    "load cell*", "loadcell*", "mgn*",       "lm8uu*", "actuator", "potentiometer*"};

/// Words of parts that give.
constexpr std::string_view kFlexible[] = {
    "o ring*", "oring*",  "circlip*", "retaining ring*", "snap ring*", "e clip*",  "eclip*", "c clip*",
    "spring",  "springs", "seal",     "seals",           "gasket*",    "grommet*", "rubber", "cable",
    "cables",  "wire",    "wires",    "hose*",           "belt*",      "cord"};

/// Words of parts that hold, cover or turn with one of those.
constexpr std::string_view kBelongs[] = {
    "mount*", "bracket*", "plate*",   "cover*", "housing*", "case",   "adapter*", "adaptor*", "assembly", "assy",
    "frame*", "base",     "support*", "clamp*", "spacer*",  "lid",    "pulley*",  "coupl*",   "screw*",   "bolt*",
    "nut",    "washer*",  "holder*",  "guide*", "anchor*",  "chain*", "tension*", "pin"};

/// Words of the components of bearings.
constexpr std::string_view kOfBearing[] = {"ball*", "roller*", "cage*",  "retainer*", "cone*",  "cup",
                                           "race*", "ring*",   "inner*", "outer*",    "shield*"};

bool fits(std::string_view pattern, std::string_view word) {
  if (pattern.empty() || pattern.back() != '*') return pattern == word;
  return word.substr(0, pattern.size() - 1) == pattern.substr(0, pattern.size() - 1);
}

/// The words from `at` on that fit a pattern, with the separator of the result; empty where they do not.
std::string fitting(const std::vector<std::string>& words, std::size_t at, std::string_view pattern) {
  const std::size_t blank = pattern.find(' ');
  if (blank == std::string_view::npos) return fits(pattern, words[at]) ? words[at] : std::string();
  if (at + 1 == words.size() || !fits(pattern.substr(0, blank), words[at]) ||
      !fits(pattern.substr(blank + 1), words[at + 1]))
    return {};
  return words[at] + (words[at].size() == 1 ? "-" : " ") + words[at + 1];
}

template <std::size_t kCount>
std::string known_word(std::string_view name, const std::string_view (&known)[kCount]) {
  const std::vector<std::string> words = words_of(name);
  std::string found;
  for (std::size_t at = 0; at < words.size() && found.empty(); ++at)
    for (std::size_t i = 0; i < kCount && found.empty(); ++i) found = fitting(words, at, known[i]);
  // A battery holder is bought with its contacts.
  if (found.empty() || found == "battery") return found;
  const auto belongs = [](const std::string& word) {
    return std::any_of(std::begin(kBelongs), std::end(kBelongs),
                       [&](std::string_view pattern) { return fits(pattern, word); });
  };
  return std::any_of(words.begin(), words.end(), belongs) ? std::string() : found;
}

}  // namespace

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool in_word = false, small = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool part = byte >= 0x80 || std::isalnum(byte);
    if (part && (!in_word || (small && std::isupper(byte)))) words.emplace_back();
    if (part) words.back() += static_cast<char>(std::tolower(byte));
    in_word = part;
    small = part && std::islower(byte);
  }
  return words;
}

std::string purchased_word(std::string_view name) {
  return known_word(name, kPurchased);
}

std::string bearing_of(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  const auto is_number = [](const std::string& word) {
    return word.find_first_not_of("0123456789") == std::string::npos;
  };
  const auto is_of_bearing = [&](const std::string& word) {
    return is_number(word) || std::any_of(std::begin(kOfBearing), std::end(kOfBearing),
                                          [&](std::string_view known) { return fits(known, word); });
  };
  std::string bearing;
  for (auto word = words.begin(); word != words.end(); ++word) {
    bearing += (bearing.empty() ? "" : " ") + *word;
    if (!fits("bearing*", *word)) continue;
    const auto rest = word + 1;
    const bool fit = std::all_of(rest, words.end(), is_of_bearing) && !std::all_of(rest, words.end(), is_number);
    return fit ? bearing : std::string();
  }
  return {};
}

std::string flexible_word(std::string_view name) {
  return known_word(name, kFlexible);
}

}  // namespace dismantle
