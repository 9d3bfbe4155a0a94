// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/audit/solid/solid_body.h"

#include <map>
#include <mutex>
#include <tuple>

namespace dismantle::audit {

/// True if a solid has a wall that is no thicker than `thickness` [mm]: somewhere on its surface, the way in along the
/// normal ends within that at a face whose normal is within 57 degrees of the opposite one. Looked for at the points of
/// followed_points(), no further apart than `spacing` [mm]. False for sheets.
bool has_thin_wall(const SolidBody& solid, double thickness, double spacing);

/// True if a solid stays in one piece where another one, as it is in the assembled state, is cut out of it: each
/// connected piece of its surface stays connected, along itself or along the surface of the cut, or is gone. Both
/// surfaces are divided where they meet; parts that are closer to each other than `finest` [mm] may be taken for
/// connected.
bool stays_in_one_piece(const SolidBody& solid, const SolidBody& cutter, double finest);

/// A cache of has_thin_wall() and stays_in_one_piece() for the solids of an assembly, shared by all its audits. Safe
/// for concurrent use.
class KnownWalls {
 public:
  /// See has_thin_wall().
  bool has_thin_wall(const SolidBody& solid, double thickness, double spacing);
  /// True if `solid` stays in one piece where `other`, as it is in the assembled state, is cut out of it.
  bool has_hole(const SolidBody& solid, const SolidBody& other, double finest);

 private:
  template <class Key, class Find>
  bool find(std::map<Key, bool>& known, const Key& key, const Find& find);

  using WallKey = std::tuple<const SolidBody*, double, double>;
  using HoleKey = std::tuple<const SolidBody*, const SolidBody*, double>;
  std::mutex mutex_;
  std::map<WallKey, bool> walls_;
  std::map<HoleKey, bool> holes_;
};

}  // namespace dismantle::audit
