// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/oracle_mesh.h"
#include "bench/families/screw_track.h"

#include <cstdint>
#include <optional>
#include <random>

namespace dismantle::families {

/// How far points may get into or past a surface.
struct PointAllowance {
  double limit = 0;                  ///< [mm]
  double limit_after_parting = 0;    ///< [mm]
  std::size_t parted_at = SIZE_MAX;  ///< The pose of the track at which the two have been apart.
  double at(std::size_t pose) const { return pose >= parted_at ? limit_after_parting : limit; }
};

/// How hard ghosts are looked for.
struct GhostEffort {
  std::size_t few = 2;         ///< More are made where fewer are left.
  std::size_t most = 6;        ///< So many are kept at most.
  std::size_t random = 0;      ///< Random places that are tried besides the usual ones.
  double smallest_step = 0.1;  ///< Motions are halved down to this share of the allowance.
  double largest_step =
      1e9;  ///< Motions are no longer than this multiple of the allowance: ghosts may part at an edge.
};

/// Follows points of one surface past another. A point is lawful if some point near it, its ghost, no further than the
/// allowance, has moved continuously and never crossed the other surface; of a solid the ghost starts outside. Kept are
/// some of the places where the ghost may be by now. A point of a solid that gets deeper than the allowance has none
/// left.
class GhostOracle {
 public:
  /// @param track of the point's body in the frame of the other surface; both must outlive the oracle
  GhostOracle(const OracleMesh& other, const ScrewTrack& track, PointAllowance allowance)
      : other_(other), track_(track), allowance_(allowance) {}

  /// The time at which a point has no ghost left; nothing if it is lawful. @param point of the body [mm]
  std::optional<double> follow(Vec3 point, const GhostEffort& effort) const;

 private:
  struct State;

  void start(State& state) const;
  bool step(State& state, double to, double limit) const;
  void spawn(State& state, const RigidTransform& at, Vec3 motion, double limit) const;
  double clear_until(const State& state, double way) const;
  double next_time(const State& state, double limit) const;

  const OracleMesh& other_;
  const ScrewTrack& track_;
  PointAllowance allowance_;
};

}  // namespace dismantle::families
