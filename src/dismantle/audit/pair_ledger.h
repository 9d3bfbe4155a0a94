// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/assembly/path.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace dismantle::audit {

/// What the audit knows about a pair from one move to the next.
struct PairRecord {
  double allowed = 0;                    ///< [mm]; the tolerance for embedded pairs, from when they are apart.
  bool embedded = false;                 ///< Declared so, and never apart yet.
  bool parted = false;                   ///< Was embedded and has been apart.
  double deepest = 0;                    ///< Of its triangles, over all samples [mm].
  std::vector<std::uint32_t> inside[2];  ///< Vertices of the first that may be inside the second; and the other way.
};

/// The records of all pairs; those that nothing is known about are ordinary.
class PairLedger {
 public:
  PairLedger(const Assembly& assembly, const Path& path);

  /// @pre a < b
  const PairRecord& find(std::uint32_t a, std::uint32_t b) const;
  PairRecord& get(std::uint32_t a, std::uint32_t b);
  /// By (a, b).
  const std::map<std::pair<std::uint32_t, std::uint32_t>, PairRecord>& records() const { return records_; }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRecord> records_;
  PairRecord ordinary_;
};

}  // namespace dismantle::audit
