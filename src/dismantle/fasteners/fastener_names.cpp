// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener_names.h"

#include "dismantle/proposals/part_names.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>
#include <vector>

namespace dismantle {

namespace {

using Kind = Fastener::Kind;
using Head = Fastener::Head;
using Drive = Fastener::Drive;

/// A word, and what it says. A word that begins with "*" may be the end of another one, one that ends with "*" its
/// beginning, one with both may be anywhere.
struct KnownWord {
  std::string_view pattern;
  Kind kind;
  Head head = Head::None;
  Drive drive = Drive::None;
};

constexpr KnownWord kWords[] = {
    {"shcs", Kind::Screw, Head::Cylinder, Drive::HexSocket},
    {"bhcs", Kind::Screw, Head::Button, Drive::HexSocket},
    {"fhcs", Kind::Screw, Head::Countersunk, Drive::HexSocket},
    {"*zylinderschraube*", Kind::Screw, Head::Cylinder, Drive::None},
    {"*sechskantschraube*", Kind::Screw, Head::Hexagon, Drive::Hexagon},
    {"*senkschraube*", Kind::Screw, Head::Countersunk, Drive::None},
    {"*linsenschraube*", Kind::Screw, Head::Button, Drive::None},
    {"*gewindestift*", Kind::Screw, Head::None, Drive::HexSocket},
    {"*screw", Kind::Screw},
    {"*screws", Kind::Screw},
    {"screw*", Kind::Screw},
    {"*bolt", Kind::Screw},
    {"*bolts", Kind::Screw},
    {"bolt*", Kind::Screw},
    {"*schraube*", Kind::Screw},
    {"*ネジ*", Kind::Screw},
    {"*ねじ*", Kind::Screw},
    {"*ボルト*", Kind::Screw},
    {"*ビス*", Kind::Screw},
    {"*螺钉*", Kind::Screw},
    {"*螺丝*", Kind::Screw},
    {"*螺栓*", Kind::Screw},
    {"nut", Kind::Nut},
    {"nuts", Kind::Nut},
    {"*locknut*", Kind::Nut},
    {"nyloc*", Kind::Nut},
    {"*mutter*", Kind::Nut},
    {"*ナット*", Kind::Nut},
    {"*螺母*", Kind::Nut},
    {"*washer*", Kind::Washer},
    {"shim*", Kind::Washer},
    {"*scheibe", Kind::Washer},
    {"*scheiben", Kind::Washer},
    {"*ワッシャ*", Kind::Washer},
    {"*座金*", Kind::Washer},
    {"*垫圈*", Kind::Washer},
    {"circlip*", Kind::Circlip},
    {"*sicherungsring*", Kind::Circlip},
    {"*seegerring*", Kind::Circlip},
    {"eclip*", Kind::Circlip},
    {"*止め輪*", Kind::Circlip},
    {"*挡圈*", Kind::Circlip},
    {"dowel*", Kind::Dowel},
    {"*zylinderstift*", Kind::Dowel},
    {"*passstift*", Kind::Dowel},
    {"*spannstift*", Kind::Dowel},
    {"*ノックピン*", Kind::Dowel},
    {"*平行ピン*", Kind::Dowel},
    {"*圆柱销*", Kind::Dowel},
    {"rivet*", Kind::Rivet},
    {"niet*", Kind::Rivet},
    {"*blindniet*", Kind::Rivet},
    {"*リベット*", Kind::Rivet},
    {"*铆钉*", Kind::Rivet},
    {"heatset*", Kind::Insert},
    {"*gewindeeinsatz*", Kind::Insert},
    {"*インサート*", Kind::Insert},
    {"standoff*", Kind::Standoff},
    {"*abstandsbolzen*", Kind::Standoff},
    {"*スタンドオフ*", Kind::Standoff},
};

/// The number of a standard, and what it is for.
struct Standard {
  int number;
  KnownWord what;
};
constexpr Standard kStandards[] = {
    {4762, {"", Kind::Screw, Head::Cylinder, Drive::HexSocket}},
    {912, {"", Kind::Screw, Head::Cylinder, Drive::HexSocket}},
    {6912, {"", Kind::Screw, Head::Cylinder, Drive::HexSocket}},
    {7984, {"", Kind::Screw, Head::Cylinder, Drive::HexSocket}},
    {14579, {"", Kind::Screw, Head::Cylinder, Drive::Torx}},
    {4014, {"", Kind::Screw, Head::Hexagon, Drive::Hexagon}},
    {4017, {"", Kind::Screw, Head::Hexagon, Drive::Hexagon}},
    {931, {"", Kind::Screw, Head::Hexagon, Drive::Hexagon}},
    {933, {"", Kind::Screw, Head::Hexagon, Drive::Hexagon}},
    {7380, {"", Kind::Screw, Head::Button, Drive::HexSocket}},
    {10642, {"", Kind::Screw, Head::Countersunk, Drive::HexSocket}},
    {7991, {"", Kind::Screw, Head::Countersunk, Drive::HexSocket}},
    {7045, {"", Kind::Screw, Head::Button, Drive::Cross}},
    {7985, {"", Kind::Screw, Head::Button, Drive::Cross}},
    {7046, {"", Kind::Screw, Head::Countersunk, Drive::Cross}},
    {965, {"", Kind::Screw, Head::Countersunk, Drive::Cross}},
    {14583, {"", Kind::Screw, Head::Button, Drive::Torx}},
    {1207, {"", Kind::Screw, Head::Cylinder, Drive::Slot}},
    {84, {"", Kind::Screw, Head::Cylinder, Drive::Slot}},
    {2009, {"", Kind::Screw, Head::Countersunk, Drive::Slot}},
    {963, {"", Kind::Screw, Head::Countersunk, Drive::Slot}},
    {4026, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {4027, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {4028, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {4029, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {913, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {914, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {915, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {916, {"", Kind::Screw, Head::None, Drive::HexSocket}},
    {4032, {"", Kind::Nut}},
    {934, {"", Kind::Nut}},
    {4035, {"", Kind::Nut}},
    {439, {"", Kind::Nut}},
    {7040, {"", Kind::Nut}},
    {985, {"", Kind::Nut}},
    {982, {"", Kind::Nut}},
    {6923, {"", Kind::Nut}},
    {7089, {"", Kind::Washer}},
    {7090, {"", Kind::Washer}},
    {7092, {"", Kind::Washer}},
    {7093, {"", Kind::Washer}},
    {125, {"", Kind::Washer}},
    {433, {"", Kind::Washer}},
    {9021, {"", Kind::Washer}},
    {127, {"", Kind::Washer}},
    {988, {"", Kind::Washer}},
    {2338, {"", Kind::Dowel}},
    {8734, {"", Kind::Dowel}},
    {8735, {"", Kind::Dowel}},
    {6325, {"", Kind::Dowel}},
    {8752, {"", Kind::Dowel}},
    {471, {"", Kind::Circlip}},
    {472, {"", Kind::Circlip}},
    {6799, {"", Kind::Circlip}},
    {660, {"", Kind::Rivet}},
    {661, {"", Kind::Rivet}},
    {15977, {"", Kind::Rivet}},
};

/// Words of parts that are no fasteners, also after the word of one: "roller", "nut holder", "bolt plate". "*" as
/// above.
constexpr std::string_view kOther[] = {
    "lead",    "leadscrew", "ball",      "ballscrew*", "ballnut*", "worm",    "holder*",      "mount*",  "bracket",
    "plate*",  "cover*",    "lid",       "housing*",   "hole*",    "driver*", "screwdriver*", "trap*",   "jig*",
    "guide*",  "*roller*",  "*bearing*", "shaft*",     "axle*",    "rod",     "rods",         "bush*",   "trunnion",
    "needle*", "magnet*",   "gear*",     "pinion*",    "wheel*",   "pulley*", "lens*",        "led",     "tube*",
    "pipe*",   "cable*",    "wire*",     "spring*",    "*lager*",  "*welle*", "pillar*",      "collar*", "race*",
    "cage*",   "seal*",     "o-ring*",   "oring*",     "gasket*",  "spacer*", "clip",         "knob*",   "contact*",
    "cap",     "motor*",    "block*",    "body*",      "ejector",  "return",  "nipple*",      "plug*"};

/// Words before the one of a fastener with which it is none.
constexpr std::string_view kOtherBefore[] = {"lead", "leadscrew", "ball", "worm", "trapezoidal", "acme", "ejector"};

bool fits(std::string_view pattern, std::string_view word) {
  const bool any_before = pattern.front() == '*', any_after = pattern.back() == '*';
  if (any_before) pattern.remove_prefix(1);
  if (any_after) pattern.remove_suffix(1);
  const std::size_t at = word.find(pattern);
  if (at == std::string_view::npos) return false;
  if (any_before && any_after) return true;
  if (any_after) return at == 0;
  return word.size() >= pattern.size() && word.substr(word.size() - pattern.size()) == pattern &&
         (any_before || word.size() == pattern.size());
}

/// The words of a name, also at borders between digits and letters; "m12" and other sizes stay together.
std::vector<std::string> split_words(std::string_view name) {
  std::vector<std::string> parts;
  for (const std::string& word : words_of(name)) {
    std::string part;
    for (std::size_t i = 0; i < word.size(); ++i) {
      const bool digit = std::isdigit(static_cast<unsigned char>(word[i])) != 0;
      const bool before = i > 0 && std::isdigit(static_cast<unsigned char>(word[i - 1])) != 0;
      if (i > 0 && digit != before) {
        parts.push_back(part);
        part.clear();
      }
      part += word[i];
    }
    parts.push_back(part);
  }
  return parts;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// A number at a place of a text, and where it ends; nothing if there is none.
std::optional<double> number_at(std::string_view text, std::size_t& at) {
  if (at >= text.size() || !is_digit(text[at])) return std::nullopt;
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data() + at, text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc()) return std::nullopt;
  at = static_cast<std::size_t>(end - text.data());
  return value;
}

void skip_blanks(std::string_view text, std::size_t& at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '_')) ++at;
}

/// Passes "x", "X", "*" or the multiplication sign between blanks; false if there is none.
bool skip_times(std::string_view text, std::size_t& at) {
  skip_blanks(text, at);
  constexpr std::string_view kTimes = "\u00d7";
  std::size_t size = 0;
  if (text.substr(at, kTimes.size()) == kTimes) size = kTimes.size();
  if (at < text.size() && (text[at] == 'x' || text[at] == 'X' || text[at] == '*')) size = 1;
  at += size;
  skip_blanks(text, at);
  return size > 0;
}

/// Reads "M5x16" or "M5".
void read_size(std::string_view name, FastenerName& found) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != 'M' && name[i] != 'm') continue;
    if (i > 0 && std::isalpha(static_cast<unsigned char>(name[i - 1])) != 0) continue;
    std::size_t at = i + 1;
    skip_blanks(name, at);
    const std::optional<double> diameter = number_at(name, at);
    if (!diameter || !(*diameter >= 1 && *diameter <= 100)) continue;
    if (at < name.size() && std::isalpha(static_cast<unsigned char>(name[at])) != 0 && name[at] != 'x' &&
        name[at] != 'X' && std::isupper(static_cast<unsigned char>(name[at])) == 0)
      continue;  // "5mm"
    found.diameter = *diameter;
    if (skip_times(name, at)) {
      // "M8x1x30" and "M8x1.25x30": the pitch, then the length.
      std::optional<double> length = number_at(name, at);
      std::size_t next = at;
      if (length && *length < 0.35 * *diameter && skip_times(name, next))
        if (const std::optional<double> last = number_at(name, next)) length = last;
      if (length) found.length = *length;
    }
    return;
  }
}

/// Reads "8x26".
void read_plain_size(std::string_view name, FastenerName& found) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_digit(name[i]) || (i > 0 && (is_digit(name[i - 1]) || name[i - 1] == '.'))) continue;
    std::size_t at = i;
    const std::optional<double> diameter = number_at(name, at);
    if (!diameter || !skip_times(name, at)) continue;
    if (const std::optional<double> length = number_at(name, at)) {
      found.diameter = *diameter;
      found.length = *length;
      return;
    }
  }
}

}  // namespace

FastenerName read_fastener_name(std::string_view name) {
  FastenerName found;
  const std::vector<std::string> words = split_words(name);
  // The last word counts: a "nut dowel" is a dowel.
  const auto take = [&found](const KnownWord& known) {
    const bool says_more = known.head != Head::None || known.drive != Drive::None;
    if (found.kind == known.kind && !says_more) return;
    found.kind = known.kind;
    found.head = known.head;
    found.drive = known.drive;
  };
  std::vector<std::size_t> naming;  // words that name a fastener
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (const KnownWord& known : kWords)
      if (fits(known.pattern, words[i])) {
        take(known);
        if (naming.empty() || naming.back() != i) naming.push_back(i);
      }
    if ((words[i] == "retaining" || words[i] == "snap") && i + 1 < words.size() && words[i + 1] == "ring")
      take({"", Kind::Circlip});
    if (i > 0 && (words[i - 1] == "iso" || words[i - 1] == "din" || words[i - 1] == "en"))
      for (const Standard& standard : kStandards)
        if (std::to_string(standard.number) == words[i]) take(standard.what);
    // "Threaded insert"; mould inserts and others have no thread.
    if (words[i] == "insert" && std::any_of(words.begin(), words.end(), [](const std::string& word) {
          return word == "m" || fits("thread*", word) || fits("heat*", word);
        }))
      take({"", Kind::Insert});
  }
  // "Nut holder" and "lead screw" are none, "lid screw" is one.
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_after = std::any_of(naming.begin(), naming.end(), [i](std::size_t named) { return i == named + 1; });
    const bool is_before = std::any_of(naming.begin(), naming.end(), [i](std::size_t named) { return i + 1 == named; });
    for (const std::string_view other : kOther) found.is_other |= (naming.empty() || is_after) && fits(other, words[i]);
    for (const std::string_view before : kOtherBefore) found.is_other |= is_before && fits(before, words[i]);
  }
  read_size(name, found);
  // "circlip 11"
  if (found.kind == Kind::Circlip && found.diameter == 0 && !words.empty() && is_digit(words.back()[0]))
    found.diameter = std::stod(words.back());
  if (found.kind && found.diameter == 0) read_plain_size(name, found);
  return found;
}

}  // namespace dismantle
