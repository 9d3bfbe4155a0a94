// SPDX-License-Identifier: Apache-2.0
// The ghost surfaces of pairs of components that touch or overlap in the assembled state, and their allowances.
#include "dismantle/certificates/ghosts/find_pair_ghosts.h"
#include "dismantle/certificates/sweep/certificate_sweeper.h"
#include "dismantle/certificates/sweep/sweep_tasks.h"
#include "dismantle/surface/solid_distance.h"

#include <limits>
#include <mutex>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The shapes of the components that overlap others, each built once.
class Shapes {
 public:
  explicit Shapes(const Assembly& assembly) : assembly_(assembly), shapes_(assembly.components.size()) {}

  const SolidShape& of(ComponentId c) {
    Built& built = shapes_[c.value];
    std::call_once(built.once, [&] { built.shape = SolidShape(assembly_[c]); });
    return built.shape;
  }

 private:
  struct Built {
    std::once_flag once;
    SolidShape shape;
  };
  const Assembly& assembly_;
  std::vector<Built> shapes_;
};

/// Two components that touch or overlap, and what was found for them.
struct Touching {
  ComponentId a, b;
  double depth = 0;
  std::optional<PairGhosts> found;
};

}  // namespace

void CertificateSweeper::prepare_ghosts(const PairStates& pairs) {
  std::vector<Touching> touching;
  for (std::uint32_t k = 0; k < poses_.size(); ++k)
    for (std::uint32_t i = 0; i < k; ++i) {
      const ComponentId a(i), b(k);
      const ComponentPair* known = pairs.find(a, b);
      if (solid(a).tree.empty() || solid(b).tree.empty()) continue;
      if (known && known->state == PairState::Free) {
        guarded_[{a, b}] = {PairGuard::None, kUnlimited};
        continue;
      }
      if (!known || known->state == PairState::Near) continue;
      touching.push_back({a, b, known->depth, {}});
      if (known->allowed_depth > tolerance_) guarded_[{a, b}].allowed = known->allowed_depth;
    }
  Shapes shapes(*assembly_);
  options_.executor.for_each_heavy(touching.size(), [&](std::size_t i) {
    Touching& t = touching[i];
    const bool overlap = t.depth > 0;
    t.found = find_pair_ghosts({{&solid(t.a), overlap ? &shapes.of(t.a) : nullptr},
                                {&solid(t.b), overlap ? &shapes.of(t.b) : nullptr},
                                &store_.ghost(t.a, t.b),
                                &store_.ghost(t.b, t.a),
                                t.depth,
                                tolerance_,
                                kernels_});
  });
  for (const Touching& t : touching) {
    if (t.found && t.found->max_length == 0) continue;
    GuardedPair& pair = guarded_[{t.a, t.b}];
    if (t.found) {
      store_.set_ghosts(t.a, t.b, t.found->vertices, options_.executor);
      pair.displaced = t.found->max_length;
      pair.allowed = std::max(pair.allowed, t.found->max_length + (1 - kGhostLength) * tolerance_);
    } else {
      pair.guard = PairGuard::Depth;
      shape(t.a);
      shape(t.b);
      pair.allowed = std::max(pair.allowed, t.depth + tolerance_);
    }
  }
}

GuardedPair CertificateSweeper::guarded(ComponentId a, ComponentId b) const {
  const auto found = guarded_.find(std::minmax(a, b));
  if (found != guarded_.end() && !found->second.parted) return found->second;
  return {PairGuard::Ghosts, tolerance_, kGhostLength * tolerance_, found != guarded_.end()};
}

std::vector<ComponentPair> CertificateSweeper::overlapping_pairs() const {
  std::vector<ComponentPair> list;
  for (const auto& [key, pair] : guarded_) {
    if (pair.parted) continue;
    const PairState state = pair.guard == PairGuard::None ? PairState::Free : PairState::Overlapping;
    list.push_back({key.first, key.second, state, 0, 0, pair.allowed});
  }
  return list;
}

Span<const SurfacePair> CertificateSweeper::surface_pairs(ComponentId a, ComponentId b) const {
  static constexpr SurfacePair kBoth[] = {SurfacePair::MovingGhost, SurfacePair::FixedGhost};
  return Span<const SurfacePair>(kBoth, guarded(a, b).guard == PairGuard::Ghosts ? 2 : 0);
}

void CertificateSweeper::set_parted(ComponentId a, ComponentId b, bool parted) {
  const auto found = guarded_.find(std::minmax(a, b));
  if (found == guarded_.end()) return;
  found->second.parted = parted;
  store_.use_own_ghosts(a, b, !parted);
}

}  // namespace dismantle
