// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/certificates/ghosts/overlap_retraction.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace dismantle {

/// A component's faces with displaced vertices, against another component at rest in the assembled state. Faces of the
/// other one are found in the boxes of displaced faces, so that a test costs what lies around the displaced surface,
/// however long the displacements are.
class DisplacedFaces {
 public:
  /// @param own, other outlive this
  /// @param tolerance [mm]
  DisplacedFaces(const OverlapSide& own, const OverlapSide& other, double tolerance)
      : own_(own), other_(other), tolerance_(tolerance) {}

  /// Displaced vertices, and how many faces of the other component their faces meet; touching counts.
  struct Meeting {
    std::vector<Vec3> vertices;          ///< Displaced [mm, assembled].
    std::vector<std::uint32_t> of_face;  ///< Number of faces that each face meets.
    std::size_t total = 0;               ///< Of all faces.
  };
  /// Counts the pairs of faces that meet.
  Meeting meeting(std::vector<Vec3> vertices) const;
  /// Counts them for other vertices, testing only the faces that change; nothing if there are `limit` or more.
  std::optional<Meeting> meeting_less(const Meeting& before, std::vector<Vec3> vertices, std::size_t limit) const;
  /// True if the displaced surface does not meet the other component, and neither is inside the other: as far as a few
  /// of their vertices tell.
  /// @param may_contain false for components that touch only: nothing is looked for inside
  bool apart(const std::vector<Vec3>& vertices, bool may_contain) const;
  /// True if the displaced surface does not meet the other component while it is shifted.
  /// @param from, to shifts at the start and the end [mm]
  bool free(const std::vector<Vec3>& vertices, Vec3 from, Vec3 to) const;
  /// True if some of a few vertices of two surfaces that do not meet are inside the other one.
  bool contained(const std::vector<Vec3>& vertices) const;
  /// The vertices, those inside the other component moved out of it the shortest way, and `gap` further [mm].
  /// @param max_length no vertex is further from its place in the component than this [mm]
  std::vector<Vec3> moved_out(std::vector<Vec3> vertices, double gap, double max_length) const;
  /// Pairs of faces that meeting() and meeting_less() have tested so far.
  std::size_t tests() const { return tests_; }

 private:
  std::optional<Meeting> count(const Meeting& before, std::vector<Vec3> vertices, std::size_t limit,
                               bool all_faces) const;

  const OverlapSide& own_;
  const OverlapSide& other_;
  double tolerance_;
  mutable std::size_t tests_ = 0;
};

}  // namespace dismantle
