// SPDX-License-Identifier: Apache-2.0
#include "dismantle/surface/depth/swept_depth.h"

#include "dismantle/surface/depth/swept_search.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace dismantle {

namespace {

/// The first part of a motion that is searched, in resolutions of time, and by how much each part ends later than the
/// one before: what lies behind a contact costs most.
constexpr double kFirstPart = 16, kPartGrowth = 8;
/// Faces that are sampled at each time, from everywhere on the surface, before more are sampled where one may be deep.
constexpr std::size_t kEvenSamples[] = {60, 400};
/// Times of a known deep point are found to within this share of the resolution.
constexpr double kTimeShare = 0.25;
/// An interval is given up, and a shorter one searched, after this share of the pieces, but not before so many.
constexpr std::size_t kShareOfPieces = 4, kFewPieces = 50000;
/// A search ends early after the interval in which its whole cost, known parts included, exceeds its pieces this many
/// times.
constexpr std::size_t kWithKnown = 2;
/// An interval that is longer than a resolution by this share is as long.
constexpr double kSameLength = 1e-6;

/// Both surfaces of a pair, each moving in the frame of the other.
class PairSearch {
 public:
  PairSearch(const SweptPair& pair, const DepthLimits& limits, double resolution, std::size_t max_pieces,
             const KeepGoing& keep_going)
      : searches_{{*pair.a, *pair.b, pair.start, pair.end,
                   DepthRule::of(*pair.b, limits.limit, limits.far_a, limits.hole_for_a ? pair.a : nullptr),
                   limits.far_a != limits.limit, pair.known_a, keep_going},
                  {*pair.b, *pair.a, inverse(pair.start), inverse(pair.end),
                   DepthRule::of(*pair.a, limits.limit, limits.far_b, limits.hole_for_b ? pair.b : nullptr),
                   limits.far_b != limits.limit, pair.known_b, keep_going}},
        resolution_(resolution),
        back_(resolution),
        until_(pair.until),
        max_pieces_(max_pieces),
        keep_going_(keep_going) {}

  /// A point that is too deep, at the time at which it becomes so; found by sampling ever later times. What blocks a
  /// long motion mostly is deep in many places: a few samples at all times come before many at some.
  std::optional<DeepPoint> sampled() {
    for (const std::size_t faces : kEvenSamples)
      if (auto found = sampled([&](SweptSearch& search, double time) { return search.sample_evenly(time, faces); }))
        return found;
    return sampled([&](SweptSearch& search, double time) { return search.sample(time, max_pieces_); });
  }

  /// Number of points and pieces examined.
  std::size_t cost() const { return pieces_ + recalled_ + searches_[0].others() + searches_[1].others(); }

  std::optional<DeepPoint> find(DeepSearch search_for) {
    double to = kFirstPart * resolution_;
    if (search_for == DeepSearch::Any)
      if (const auto found = sampled()) return found;
    searches_[1].begin();
    const auto ended_at = searches_[0].begin();
    bool goes_on = ended_at && ended_at->to <= until_;
    if (goes_on) {
      to = resume(*ended_at);
      goes_on = ended_at->in_search;
    } else if (is_again_shallow(until_)) {
      return std::nullopt;
    }
    for (;;) {
      // A point that is known to be deep leaves a shorter motion to search.
      if (is_decided(search_for)) break;
      to = std::min(to, known_ ? known_->time - resolution_ : until_);
      if (known_) to = std::min(to, std::max(free_until_ + resolution_, known_->time - back_));
      const double free_before = free_until_;
      const bool is_searched = search(to, std::exchange(goes_on, false));
      const bool is_last = cost() > kWithKnown * max_pieces_ || (keep_going_ && !keep_going_());
      if (is_searched) {
        back_ = free_until_ > free_before ? resolution_ : 2 * back_;
        to = std::max(kPartGrowth * free_until_, free_until_ + resolution_);
        if (!is_last || is_decided(search_for)) continue;
      } else if (!is_last && to - free_until_ > (1 + kSameLength) * resolution_) {
        to = free_until_ + std::max(resolution_, (to - free_until_) / kPartGrowth);
        continue;
      }
      end_undecided(to, !is_searched);
      break;
    }
    for (const int of : {0, 1})
      searches_[of].note_deep(known_ && is_certain_ && of == of_ ? std::optional(known_->own) : std::nullopt);
    if (!known_) return std::nullopt;
    DeepPoint point = searches_[of_].deep_point(*known_, of_ == 0);
    point.is_certain = is_certain_;
    point.free_until = free_until_;
    return point;
  }

 private:
  /// A point that sample(search, time) finds at ever later times.
  template <class Sample>
  std::optional<DeepPoint> sampled(const Sample& sample) {
    for (double time = kFirstPart * resolution_;; time *= 2) {
      for (const int of : {0, 1})
        if (const auto found = sample(searches_[of], std::min(until_, time))) {
          know(*found, of);
          return searches_[of].deep_point(*known_, of == 0);
        }
      if (time >= until_) return std::nullopt;
    }
  }

  /// True if what is known leaves nothing to search.
  bool is_decided(DeepSearch search_for) const {
    if (known_ && search_for == DeepSearch::Any) return true;
    return free_until_ >= (known_ ? known_->time - resolution_ : until_);
  }

  /// Ends early: it counts as if a point were deep at the end of what was to be searched next.
  void end_undecided(double to, bool in_search) {
    ShallowParts::EndedAt end;
    end.free_until = free_until_;
    end.to = std::min(to, until_);
    end.in_search = in_search;
    end.back = back_;
    end.deep = known_;
    end.of_a = of_ == 0;
    searches_[0].note_end(end);
    is_certain_ = false;
    if (!known_) known_ = TimedPoint{end.to, 0, {}};
    known_->time = std::min(known_->time, end.to);
  }

  /// Takes up a search that ended early. @return up to where it is to be searched next
  double resume(const ShallowParts::EndedAt& end) {
    free_until_ = end.free_until;
    back_ = end.back;
    known_ = end.deep;
    of_ = end.of_a ? 0 : 1;
    return end.to;
  }

  /// True if it is free up to a time for reasons that are known.
  bool is_again_shallow(double to) {
    if (recalled_ > max_pieces_ / 2) return false;
    return searches_[0].is_shallow_again(free_until_, to, recalled_, max_pieces_ / 2) &&
           searches_[1].is_shallow_again(free_until_, to, recalled_, max_pieces_ / 2);
  }

  /// Searches up to a time: either it is free until then, or an earlier deep point is known. @return false if undecided
  /// @param goes_on the search of this interval ended early
  bool search(double to, bool goes_on) {
    if (!goes_on) {
      if (is_again_shallow(to)) {
        free_until_ = to;
        return true;
      }
      for (const int of : {0, 1})
        if (const auto found = searches_[of].sample(to, max_pieces_)) return know(*found, of);
    }
    const std::size_t most = max_pieces_ - std::min(recalled_, max_pieces_);
    const std::size_t enough = pieces_ + std::max(most / kShareOfPieces, std::min(most, kFewPieces));
    for (const int of : {0, 1}) {
      const SweptSearch::Result result = searches_[of].find(free_until_, to, pieces_, enough);
      if (result.found) return know(*result.found, of);
      if (!result.complete) return false;
    }
    free_until_ = to;
    return true;
  }

  /// Takes a deep point at the earliest time since which it is deep, as far as halving finds it.
  bool know(TimedPoint found, int of) {
    double shallow = free_until_;
    while (found.time - shallow > kTimeShare * resolution_) {
      const double middle = (shallow + found.time) / 2;
      if (searches_[of].is_deep(found.own, middle)) {
        found.time = middle;
      } else {
        shallow = middle;
      }
    }
    known_ = found;
    of_ = of;
    return true;
  }

  SweptSearch searches_[2];
  double resolution_;
  double back_;  // points next to a deep one mostly are deep a little earlier: ever longer steps back
  double until_;
  std::size_t max_pieces_;
  const KeepGoing& keep_going_;
  std::size_t pieces_ = 0;    // examined so far
  std::size_t recalled_ = 0;  // examined for reasons that were known
  double free_until_ = 0;
  std::optional<TimedPoint> known_;
  bool is_certain_ = true;
  int of_ = 0;
};

}  // namespace

std::optional<DeepPoint> first_deeper(const SweptPair& pair, const DepthLimits& limits, double resolution,
                                      std::size_t max_pieces, const KeepGoing& keep_going, DeepSearch search_for,
                                      std::size_t* cost) {
  if (pair.a->empty() || pair.b->empty()) return std::nullopt;
  PairSearch search(pair, limits, resolution, max_pieces, keep_going);
  std::optional<DeepPoint> found = search.find(search_for);
  if (cost) *cost += search.cost();
  return found;
}

}  // namespace dismantle
