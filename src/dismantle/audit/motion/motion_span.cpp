// SPDX-License-Identifier: Apache-2.0
#include "dismantle/audit/motion/motion_span.h"

#include <algorithm>
#include <cmath>

namespace dismantle::audit {

namespace {

/// The path of a body's centre in a segment [mm].
struct Track {
  Vec3 center;  // at the start
  Vec3 center_at_end;
  double path_length = 0;  // of the centre
};

Track track_of(const MotionSegment& segment, Vec3 center_assembled) {
  Track track;
  track.center = transform_from_pose(segment.start) * center_assembled;
  const Screw& screw = segment.screw;
  const Vec3 velocity = screw.velocity + cross(screw.angle * screw.axis, track.center - screw.reference);
  track.path_length = length(velocity);
  track.center_at_end = transform_from_pose(screw_at(screw, 1)) * track.center;
  return track;
}

double angle_between(const Quat& a, const Quat& b) {
  const Quat q = conjugate(a) * b;
  return 2 * std::atan2(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z), std::fabs(q.w));
}

struct SpanBuilder {
  const std::vector<MotionSegment>& segments;
  std::uint32_t base;
  std::vector<Track> tracks;
  std::vector<MotionSpan> spans;

  void bound(MotionSpan& span) const {
    const Track& reference = tracks[span.middle - base];
    for (std::uint32_t k = span.first; k < span.first + span.count; ++k) {
      const Track& track = tracks[k - base];
      const double to_start = length(track.center - reference.center);
      const double to_end = length(track.center_at_end - reference.center);
      // At every time the centre is within half of the path length of one of the two ends.
      span.shift = std::max(span.shift, std::max(to_start, to_end) + track.path_length / 2);
      const double turned = angle_between(segments[span.middle].start.rotation, segments[k].start.rotation);
      span.turn = std::max(span.turn, turned + segments[k].screw.angle);
    }
  }

  std::uint32_t build(std::uint32_t first, std::uint32_t count) {
    const auto index = static_cast<std::uint32_t>(spans.size());
    MotionSpan span;
    span.first = first;
    span.count = count;
    span.middle = first + count / 2;
    bound(span);
    spans.push_back(span);
    if (count == 1) return index;
    build(first, count / 2);
    const std::uint32_t right = build(span.middle, count - count / 2);
    spans[index].right = right;
    return index;
  }
};

}  // namespace

std::vector<MotionSegment> motion_segments(const std::vector<Frame>& frames) {
  std::vector<MotionSegment> segments;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    if (frames[k].pose == frames[k + 1].pose) continue;
    segments.push_back({k, frames[k].time, frames[k + 1].time - frames[k].time, frames[k].pose,
                        screw_between(frames[k].pose, frames[k + 1].pose)});
  }
  if (!frames.empty()) segments.push_back({frames.size() - 1, frames.back().time, 0, frames.back().pose, Screw{}});
  return segments;
}

std::vector<MotionSpan> motion_spans(const std::vector<MotionSegment>& segments, std::uint32_t first,
                                     std::uint32_t count, const AuditBody& body) {
  SpanBuilder builder{segments, first, {}, {}};
  for (std::uint32_t k = first; k < first + count; ++k) builder.tracks.push_back(track_of(segments[k], body.center()));
  builder.build(first, count);
  return builder.spans;
}

}  // namespace dismantle::audit
