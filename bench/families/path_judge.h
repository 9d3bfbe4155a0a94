// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/families/ghost_oracle.h"
#include "bench/families/oracle_mesh.h"

#include <vector>

namespace dismantle::families {

/// Two meshes, the first of which moves.
struct JudgedPair {
  OracleMesh moving, fixed;
  double tolerance = 0;  ///< [mm]
};

/// What an oracle says of a path.
struct Verdict {
  double start_depth = 0;     ///< In the assembled state, an upper bound [mm].
  double ratio = 0;           ///< Worst depth over the allowance: the tolerance, or else the initial depth plus that.
  bool beyond = false;        ///< That is more than the oracle allows.
  double beyond_at = 0;       ///< The time, in poses of the path.
  bool passed = false;        ///< A point has no ghost left.
  double passed_at = 0;       ///< The time.
  double passed_by = 0;       ///< Its ghost would need about this multiple of what the oracle allows.
  bool passed_moving = true;  ///< It is a point of the moving surface.
  Vec3 passed_point;          ///< The point [mm, assembled].
  std::size_t doubted = 0;    ///< Points that were lawful only on a closer look.
};

/// How a path is judged.
struct JudgeOptions {
  double extra = 1;     ///< Tolerances that an overlapping pair may have beyond its initial depth and the tolerance.
  double declared = 0;  ///< Depth that the engine says it allows, up to 1.25 times the allowance [mm].
  double sagittas = 0;  ///< Sum of those of coaxial cylinders, by which the allowance is larger [mm].
  double slack = 1.03;  ///< Multiple of the tolerance that a point of other pairs may use up.
  int depths = 40;      ///< Times at which the depth is searched for.
  std::size_t samples = 600;      ///< Of each surface: vertices, and as many points of edges and faces.
  std::vector<Vec3> near_moving;  ///< Points about which the moving surface is sampled densely [mm, assembled].
  std::vector<Vec3> near_fixed;   ///< The same for the fixed surface.
  std::uint64_t seed = 1;
};

/// Overlaps below this share of the tolerance count as touching.
inline constexpr double kTouching = 0.02;

/// Judges a path: poses of which each follows the one before by one screw.
Verdict judge(const JudgedPair& pair, const std::vector<Pose>& poses, const JudgeOptions& options);

}  // namespace dismantle::families
