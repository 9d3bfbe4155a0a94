// SPDX-License-Identifier: Apache-2.0
// The ghost surfaces of pairs of components that touch in the assembled state.
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/certificates/sweep/separating_ghost.h"
#include "dismantle/certificates/sweep/sweep_tasks.h"
#include "dismantle/surface/solid_distance.h"

#include <utility>

namespace dismantle {

namespace {

/// Ghosts made for a pair are apart by this share of the tolerance if they can be.
constexpr double kGhostGap = 0.62;

}  // namespace

void CertificateSweeper::prepare_ghosts() {
  std::vector<std::pair<ComponentId, ComponentId>> near;
  for (std::uint32_t k = 0; k < poses_.size(); ++k)
    for (std::uint32_t i = 0; i < k; ++i) {
      const ComponentId a(i), b(k);
      if (solid(a).tree.empty() || solid(b).tree.empty() || allowed(a, b) != tolerance()) continue;
      if (bounds_distance({&solid(a), {}}, {&solid(b), {}}) <= tolerance()) near.emplace_back(a, b);
    }
  std::vector<std::uint8_t> apart(near.size());
  options_.executor.for_each_heavy(near.size(),
                                   [&](std::size_t i) { apart[i] = ghosts_apart(near[i].first, near[i].second); });
  for (std::size_t i = 0; i < near.size(); ++i)
    if (apart[i] == 0 && !separate_ghosts(near[i].first, near[i].second)) plain_pairs_.insert(near[i]);
}

bool CertificateSweeper::ghosts_apart(ComponentId a, ComponentId b) const {
  return sweep_linear({a, b, {}, {}, {}}, 0, 1).free;
}

bool CertificateSweeper::separate_ghosts(ComponentId a, ComponentId b) {
  const double max_length = kGhostLength * tolerance(), gap = kGhostGap * tolerance();
  const ScrewMotion rest = screw_motion({}, {}, {}, 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> near = near_faces(a, b, rest, max_length + gap);
  const auto of_a = separating_ghost({&solid(a), &solid(b), store_.ghost(a, b).vertices, near, max_length, gap, true});
  for (auto& [face_a, face_b] : near) std::swap(face_a, face_b);
  const auto of_b = separating_ghost({&solid(b), &solid(a), store_.ghost(b, a).vertices, near, max_length, gap, false});
  if (!of_a || !of_b) return false;
  store_.set_ghosts(a, b, *of_a, *of_b, options_.executor);
  return ghosts_apart(a, b);
}

}  // namespace dismantle
