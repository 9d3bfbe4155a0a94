// SPDX-License-Identifier: Apache-2.0
#include "dismantle/joints/joint.h"

#include "dismantle/files/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dismantle {

namespace {

/// Significant digits of numbers in texts.
constexpr int kDigits = 3;

/// Turns to the nearest half, at least half a one.
double halves(double turns) {
  return std::max(0.5, std::round(2 * turns) / 2);
}

/// The text of a motion of the thread. @param verb "unscrew" @param sense in which a right-hand thread turns, and a
/// left-hand one
std::string text_of(const Unscrewing& u, const std::string& verb, const std::array<const char*, 2>& sense) {
  const std::string travel = ", " + number_text(u.travel, kDigits) + " mm";
  if (!(u.turns > 0)) return verb + travel;
  const double turns = halves(u.turns);
  return verb + " " + number_text(turns, kDigits) + (turns > 1 ? " turns " : " turn ") + sense[u.left_handed ? 1 : 0] +
         (u.left_handed ? " (left-hand thread)" : "") + travel + (u.nominal ? " (nominal pitch " : " (pitch ") +
         number_text(u.pitch, kDigits) + " mm)";
}

}  // namespace

std::string unscrewing_text(const Unscrewing& u) {
  return text_of(u, "unscrew", {"anticlockwise", "clockwise"});
}

std::string screwing_in_text(const Unscrewing& u) {
  return text_of(u, "screw in", {"clockwise", "anticlockwise"});
}

std::vector<ComponentId> Joint::stack() const {
  std::vector<ComponentId> all = nuts;
  for (const NutInsert& ring : nut_inserts) all.push_back(ring.insert);
  all.insert(all.end(), nut_washers.begin(), nut_washers.end());
  if (screw.valid()) all.push_back(screw);
  all.insert(all.end(), head_washers.begin(), head_washers.end());
  return all;
}

}  // namespace dismantle
