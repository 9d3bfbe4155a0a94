// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace dismantle::audit {

/// The state of a pair between two moves of an audit.
struct PairRecord {
  double allowed = 0;                    ///< Its allowance [mm]; for embedded pairs, the one after they part.
  bool embedded = false;                 ///< Declared embedded and not parted yet.
  bool parted = false;                   ///< Declared embedded and parted.
  double deepest = 0;                    ///< Largest depth of its triangles over all samples [mm].
  std::vector<std::uint32_t> inside[2];  ///< Vertices of the first that may be inside the second, and vice versa.
};

/// The records of all pairs. Pairs without one have the tolerance as their allowance.
class PairLedger {
 public:
  /// Takes the allowances and embedded pairs that the path declares.
  PairLedger(const Assembly& assembly, const Path& path);

  /// The record of a pair, or that of an ordinary one. @pre a < b
  const PairRecord& find(std::uint32_t a, std::uint32_t b) const;
  /// The record of a pair, created where there is none. @pre a < b
  PairRecord& get(std::uint32_t a, std::uint32_t b);
  /// All records by (a, b).
  const std::map<std::pair<std::uint32_t, std::uint32_t>, PairRecord>& records() const { return records_; }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRecord> records_;
  PairRecord ordinary_;
};

}  // namespace dismantle::audit
