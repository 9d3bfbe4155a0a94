// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/geometry/triangle.h"
#include "dismantle/math/rigid_transform.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace dismantle {

/// Why no point of a part of a face gets too deep (MovingPartSearch).
enum class ShallowReason : std::uint8_t {
  Region,      ///< It stays in the solid's shallow region, be it all of space.
  NearFaces,   ///< It stays within the limit of one face of the solid, or of that and another one.
  ThickFaces,  ///< The same of faces that are not at a thin place, and their limit.
  Ball,        ///< A ball around it is outside.
  Copy,        ///< A shifted copy of it is outside.
  Unknown,     ///< The search ended before it was examined.
};

/// Why far points of a part may get as deep as others (DepthRule).
enum class LargerLimit : std::uint8_t {
  No,       ///< They may not.
  WasNear,  ///< There are none: its points were near in the assembled state.
  InHole,   ///< It stays in the hole.
};

/// A reason, and what it refers to.
struct ShallowProof {
  ShallowReason reason{};       ///< See there.
  LargerLimit larger{};         ///< The limit that Region, NearFaces and Copy refer to.
  std::uint32_t face = 0;       ///< Of the solid; for NearFaces, ThickFaces and Ball.
  std::uint32_t hole_face = 0;  ///< Of the hole; for InHole.
  Vec3 shift{};                 ///< Of the copy [mm, frame of the solid].
};

/// A part of a face during a part of a motion in which it stayed shallow.
struct ShallowPart {
  Triangle own;        ///< Corners in the frame of the face [mm].
  double from = 0;     ///< The beginning, as a share of the interval in which the face was searched.
  double to = 1;       ///< The end.
  ShallowProof proof;  ///< Why it did.
};

/// A point of a surface at a time of a motion.
struct TimedPoint {
  double time = 0;         ///< As a share of the motion.
  std::uint32_t face = 0;  ///< The face that it is on.
  Vec3 own;                ///< The point in its own frame [mm].
};

/// How the faces of a surface were divided by searches of earlier motions of the same two shapes, with the same limits,
/// which found that no point gets too deep. Most parts of the next motion are shallow for the same reasons; these are
/// tested again. Only where the motion is the same as before is nothing tested twice: a search that ended early goes
/// on. Where points get too deep, it may depend on what is known which of them is found.
class ShallowParts {
 public:
  /// Begins a search. @param start, end the poses of the moving shape in the frame of the other one @return true if the
  /// motion is the same as that of the search before
  bool begin(const RigidTransform& start, const RigidTransform& end);
  /// The parts of a face; null where none are known.
  const std::vector<ShallowPart>* of(std::uint32_t face) const;
  /// Replaces the parts of a face; none: they are forgotten.
  void set(std::uint32_t face, std::vector<ShallowPart> parts);
  /// Replaces the parts of a face that is known by a finer subdivision.
  void refine(std::uint32_t face, std::vector<ShallowPart> parts);
  /// Notes that the first parts of a known face, apart from those whose reason is Unknown, stay shallow in an interval
  /// of the present motion.
  void note_proved(std::uint32_t face, std::size_t first, double from, double to);
  /// The number of first parts that were noted so for the same interval of the present motion. @pre the face has parts
  std::size_t proved(std::uint32_t face, double from, double to) const;
  /// A face may have been subdivided more finely, for an earlier motion, than the present one needs. Returns the number
  /// of pieces to spend on subdividing it again, or 0 if that is not due. Attempts get rarer over time.
  std::size_t due(std::uint32_t face);
  /// Forgets everything.
  void clear();

  /// A point that was too deep in the motion before [mm, frame of the face], and may be again.
  std::optional<Vec3> deep;
  /// Where a search of a pair ended early.
  struct EndedAt {
    double free_until = 0;             ///< Both surfaces stay shallow until this time of the motion.
    double to = 0;                     ///< They were searched up to this one,
    bool in_search = true;             ///< and that search did not end.
    double back = 0;                   ///< The search was to step back from a deep point by this much [of the motion].
    std::optional<TimedPoint> deep{};  ///< A point that is too deep, if one is known.
    bool of_a = true;                  ///< It is a point of `a`.
  };
  std::optional<EndedAt> ended_at;  ///< Of the present motion.

 private:
  struct Entry {
    std::vector<ShallowPart> parts;
    unsigned waited = 0, wait = 1;  // times that it was asked for
    std::size_t motion = 0, proved = 0;
    double from = 0, to = 0;
  };
  RigidTransform start_, end_;
  std::size_t motion_ = 0;  // counts motions that differ from those before
  std::unordered_map<std::uint32_t, Entry> faces_;
  std::size_t count_ = 0;
};

}  // namespace dismantle
