// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/matrix_stream.h"

#include <array>
#include <map>
#include <utility>

namespace dismantle {

namespace {

/// All numbers of a component's motion, for comparisons.
using MotionKey = std::array<double, 24>;

MotionKey motion_key(const RigidTransform& start, const RigidTransform& end) {
  MotionKey key;
  auto next = key.begin();
  for (const RigidTransform* t : {&start, &end}) {
    for (const Vec3& v : {t->rotation.row[0], t->rotation.row[1], t->rotation.row[2], t->translation})
      for (int k = 0; k < 3; ++k) *next++ = v[k];
  }
  return key;
}

std::vector<ComponentId> replace(std::vector<RigidTransform>& transforms, Span<const RigidTransform> with) {
  DISMANTLE_EXPECT(transforms.size() == with.size());
  std::vector<ComponentId> replaced;
  for (std::uint32_t c = 0; c < with.size(); ++c) {
    if (transforms[c] == with[c]) continue;
    transforms[c] = with[c];
    replaced.push_back(ComponentId(c));
  }
  return replaced;
}

}  // namespace

MatrixStream::MatrixStream(std::size_t component_count)
    : start_(component_count),
      end_(component_count),
      fitted_start_(component_count),
      fitted_end_(component_count),
      motion_class_(component_count, 0) {}

std::vector<ComponentId> MatrixStream::set_next(Span<const RigidTransform> next) {
  std::vector<ComponentId> changed = replace(end_, next);
  classify_motion();
  return changed;
}

std::vector<ComponentId> MatrixStream::set_start(Span<const RigidTransform> state) {
  std::vector<ComponentId> changed = replace(start_, state);
  classify_motion();
  return changed;
}

void MatrixStream::classify_motion() {
  std::map<MotionKey, std::uint32_t> classes;
  for (std::size_t c = 0; c < motion_class_.size(); ++c) {
    motion_class_[c] = 0;
    if (start_[c] == end_[c]) continue;
    const auto next_class = static_cast<std::uint32_t>(classes.size() + 1);
    motion_class_[c] = classes.try_emplace(motion_key(start_[c], end_[c]), next_class).first->second;
  }
}

std::vector<ComponentId> MatrixStream::take_outdated_bounds() {
  std::vector<ComponentId> unfitted;
  for (std::uint32_t c = 0; c < motion_class_.size(); ++c) {
    if (fitted_start_[c] == start_[c] && fitted_end_[c] == end_[c]) continue;
    fitted_start_[c] = start_[c];
    fitted_end_[c] = end_[c];
    unfitted.push_back(ComponentId(c));
  }
  return unfitted;
}

void MatrixStream::commit() {
  std::swap(start_, end_);
}

}  // namespace dismantle
