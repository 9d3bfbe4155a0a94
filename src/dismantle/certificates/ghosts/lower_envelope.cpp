// SPDX-License-Identifier: Apache-2.0
#include "dismantle/certificates/ghosts/lower_envelope.h"

#include "dismantle/core/contract.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// A part of a segment. Values come from the whole segment, so that rounding does not add up.
struct EnvelopePart {
  double begin, end;
  const GraphSegment* of;
};
using Envelope = std::vector<EnvelopePart>;

void append(Envelope& envelope, double begin, double end, const GraphSegment* of) {
  if (!(begin < end)) return;
  if (!envelope.empty() && envelope.back().of == of && envelope.back().end == begin) {
    envelope.back().end = end;
  } else {
    envelope.push_back({begin, end, of});
  }
}

/// The lower one of two envelopes.
Envelope lower_of(const Envelope& a, const Envelope& b) {
  Envelope lower;
  auto p = a.begin(), q = b.begin();
  for (double x = -std::numeric_limits<double>::infinity();;) {
    while (p != a.end() && p->end <= x) ++p;
    while (q != b.end() && q->end <= x) ++q;
    if (p == a.end() && q == b.end()) return lower;
    const bool over_a = p != a.end() && p->begin <= x, over_b = q != b.end() && q->begin <= x;
    double next = std::numeric_limits<double>::infinity();
    if (p != a.end()) next = std::min(next, over_a ? p->end : p->begin);
    if (q != b.end()) next = std::min(next, over_b ? q->end : q->begin);
    if (over_a && over_b) {
      const double before = p->of->at(x) - q->of->at(x), after = p->of->at(next) - q->of->at(next);
      const GraphSegment *first = before <= 0 ? p->of : q->of, *second = after <= 0 ? p->of : q->of;
      const double cross = first == second ? next : std::clamp(x + before / (before - after) * (next - x), x, next);
      append(lower, x, cross, first);
      append(lower, cross, next, second);
    } else if (over_a || over_b) {
      append(lower, x, next, over_a ? p->of : q->of);
    }
    x = next;
  }
}

Envelope envelope_of(Span<const GraphSegment> segments) {
  if (segments.size() == 1) return {{segments[0].x0, segments[0].x1, &segments[0]}};
  const std::size_t half = segments.size() / 2;
  return lower_of(envelope_of({segments.data(), half}), envelope_of({segments.data() + half, segments.size() - half}));
}

}  // namespace

double GraphSegment::at(double x) const {
  return y0 + std::clamp((x - x0) / (x1 - x0), 0.0, 1.0) * (y1 - y0);
}

std::vector<GraphSegment> lower_envelope(Span<const GraphSegment> segments) {
  if (segments.empty()) return {};
  for (const GraphSegment& s : segments) DISMANTLE_EXPECT(s.x0 < s.x1);
  std::vector<GraphSegment> parts;
  for (const EnvelopePart& part : envelope_of(segments))
    parts.push_back({part.begin, part.of->at(part.begin), part.end, part.of->at(part.end)});
  return parts;
}

}  // namespace dismantle
