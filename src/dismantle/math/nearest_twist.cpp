// SPDX-License-Identifier: Apache-2.0
#include "dismantle/math/nearest_twist.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dismantle {

namespace {

constexpr int kSize = 6;

/// A half-space is added to the active set if it is violated by more than this, relative to |wanted| for unit normals.
constexpr double kViolation = 1e-12;
/// A unit normal is dependent on the active ones if its part outside their span is shorter than this. If its part in
/// the span has no positive weights, it is violated by at most kDependent |x|: its bound, like theirs, is at most 0.
constexpr double kDependent = 0.25 * kNearestTwistSlack;
/// Number of violated half-spaces that are examined by themselves before all half-spaces are examined again.
constexpr std::size_t kListed = 24;
/// Sums of squares between these neither overflow nor lose digits.
constexpr double kSmallestSquare = 1e-200, kLargestSquare = 1e200;
/// Smaller weights of an active normal in another unit normal are rounding.
constexpr double kWeightNoise = 1e-13;

struct Vec6 {
  double v[kSize] = {};
};

double dot(const Vec6& a, const Vec6& b) {
  double sum = 0;
  for (int i = 0; i < kSize; ++i) sum += a.v[i] * b.v[i];
  return sum;
}

/// a + t b
Vec6 advanced(Vec6 a, double t, const Vec6& b) {
  for (int i = 0; i < kSize; ++i) a.v[i] += t * b.v[i];
  return a;
}

/// The length, without intermediate overflow or underflow.
double safe_length(const double (&v)[kSize]) {
  double squared = 0;
  for (const double c : v) squared += c * c;
  if (squared > kSmallestSquare && squared < kLargestSquare) return std::sqrt(squared);
  double largest = 0;
  for (const double c : v) largest = std::fmax(largest, std::fabs(c));
  if (!(largest > 0)) return 0;
  double sum = 0;
  for (const double c : v) sum += (c / largest) * (c / largest);
  return largest * std::sqrt(sum);
}

/// A half-space with a unit normal and its bound relative to |wanted|.
struct Row {
  Vec6 normal;
  double bound = 0;
};

Row scaled_row(const HalfSpace& half_space, double scale) {
  Row row;
  const double length = safe_length(half_space.normal);
  if (!(length > 0)) return row;
  const double inverse = 1 / length;
  for (int i = 0; i < kSize; ++i) row.normal.v[i] = half_space.normal[i] * inverse;
  row.bound = half_space.bound / length / scale;
  return row;
}

/// The active rows: their indices, their multipliers, and the factors N = Q R of their unit normals.
class ActiveSet {
 public:
  int count() const { return count_; }
  int row(int k) const { return rows_[k]; }
  bool contains(int row) const {
    for (int k = 0; k < count_; ++k)
      if (rows_[k] == row) return true;
    return false;
  }

  /// A unit normal split by the span of the active ones.
  struct Split {
    Vec6 outside;                ///< Its part orthogonal to the span.
    double length = 0;           ///< Of that part; 0 where the normal counts as dependent.
    double along[kSize] = {};    ///< Q^T n
    double weights[kSize] = {};  ///< R^-1 Q^T n: the span's part as a combination of active normals.
  };

  Split split(const Vec6& normal) const {
    Split s;
    s.outside = normal;
    // The second pass removes what the rounding of the first one left in the span.
    for (int pass = 0; pass < 2; ++pass) {
      for (int k = 0; k < count_; ++k) {
        const double d = dot(q_[k], s.outside);
        s.along[k] += d;
        s.outside = advanced(s.outside, -d, q_[k]);
      }
    }
    const double length = std::sqrt(dot(s.outside, s.outside));
    s.length = count_ < kSize && length > kDependent ? length : 0;
    for (int k = count_ - 1; k >= 0; --k) {
      double rest = s.along[k];
      for (int j = k + 1; j < count_; ++j) rest -= r_[k][j] * s.weights[j];
      s.weights[k] = rest / r_[k][k];
    }
    return s;
  }

  /// The active row whose multiplier is the first to reach 0 when that of the entering one grows.
  struct Blocking {
    int index = -1;
    double step = std::numeric_limits<double>::infinity();
  };
  Blocking blocking(const Split& s) const {
    Blocking first;
    for (int k = 0; k < count_; ++k) {
      if (!(s.weights[k] > kWeightNoise)) continue;
      const double step = multipliers_[k] / s.weights[k];
      if (step < first.step) first = {k, step};
    }
    return first;
  }

  void advance(double step, const Split& s) {
    for (int k = 0; k < count_; ++k) multipliers_[k] = std::fmax(0.0, multipliers_[k] - step * s.weights[k]);
  }

  /// @pre s.length > 0
  void add(int row, const Row& scaled, double multiplier, const Split& s) {
    DISMANTLE_EXPECT(count_ < kSize && s.length > 0);
    for (int k = 0; k < count_; ++k) r_[k][count_] = s.along[k];
    r_[count_][count_] = s.length;
    for (int i = 0; i < kSize; ++i) q_[count_].v[i] = s.outside.v[i] / s.length;
    rows_[count_] = row;
    normals_[count_] = scaled.normal;
    multipliers_[count_] = multiplier;
    ++count_;
  }

  /// Removes the k-th row and orthogonalises those after it again.
  void drop(int k) {
    const int last = count_;
    count_ = k;
    for (int j = k + 1; j < last; ++j) {
      const Row row{normals_[j], 0};
      const Split s = split(row.normal);
      // With fewer rows a row is not less independent, but rounding may put it on either side of the limit.
      if (s.length > 0) add(rows_[j], row, multipliers_[j], s);
    }
  }

 private:
  int count_ = 0;
  int rows_[kSize] = {};
  Vec6 normals_[kSize];
  double multipliers_[kSize] = {};
  Vec6 q_[kSize];
  double r_[kSize][kSize] = {};  // upper triangle: r_[i][j] for i <= j
};

/// The half-space that x violates most, by distance.
struct Violated {
  int index = -1;
  double distance = 0;
};

/// The half-spaces with unit normals, one array for each coordinate, so that compilers use vector instructions.
class Rows {
 public:
  explicit Rows(double scale) : scale_(scale) {}

  void add(Span<const HalfSpace> half_spaces) {
    for (std::vector<double>& column : columns_) column.reserve(count() + half_spaces.size());
    for (const HalfSpace& half_space : half_spaces) {
      const Row row = scaled_row(half_space, scale_);
      for (std::size_t c = 0; c < kSize; ++c) columns_[c].push_back(row.normal.v[c]);
      columns_[kSize].push_back(row.bound);
    }
  }

  std::size_t count() const { return columns_[kSize].size(); }
  Row operator[](std::size_t i) const {
    Row row;
    for (std::size_t c = 0; c < kSize; ++c) row.normal.v[c] = columns_[c][i];
    row.bound = columns_[kSize][i];
    return row;
  }

  /// How far x is outside each of the half-spaces; negative inside.
  const std::vector<double>& distances(const Vec6& x) {
    distances_.resize(count());
    const double *n0 = columns_[0].data(), *n1 = columns_[1].data(), *n2 = columns_[2].data(), *n3 = columns_[3].data(),
                 *n4 = columns_[4].data(), *n5 = columns_[5].data(), *bound = columns_[kSize].data();
    double* to = distances_.data();
    const double x0 = x.v[0], x1 = x.v[1], x2 = x.v[2], x3 = x.v[3], x4 = x.v[4], x5 = x.v[5];
    for (std::size_t i = 0; i < distances_.size(); ++i)
      to[i] = bound[i] - (n0[i] * x0 + n1[i] * x1 + n2[i] * x2 + n3[i] * x3 + n4[i] * x4 + n5[i] * x5);
    return distances_;
  }

 private:
  double scale_;
  std::vector<double> columns_[kSize + 1];  // of the normals; the last one of the bounds
  std::vector<double> distances_;           // that were computed last
};

class Search {
 public:
  Search(const double (&wanted)[kSize], double scale) : wanted_(wanted), scale_(scale), rows_(scale) {
    for (int i = 0; i < kSize; ++i) x_.v[i] = wanted[i] / scale;
  }

  /// Goes on with more half-spaces.
  const NearestTwist& add(Span<const HalfSpace> half_spaces) {
    rows_.add(half_spaces);
    listed_.clear();
    run(result_);
    return result_;
  }

 private:
  void run(NearestTwist& result) {
    result.nearest = true;
    while (true) {
      Violated worst = max_of_listed();
      const bool of_all = worst.index < 0;
      if (of_all) worst = max_violated();
      if (worst.index < 0) break;
      const int before = result.iterations;
      if (activate(worst.index, result.iterations)) continue;
      const bool unchanged = result.iterations == before + 1;
      listed_.clear();
      if (!of_all && unchanged) continue;
      // Dependent and hardly violated, at the first try: no other row is violated by more.
      result.nearest = unchanged && worst.distance <= 2 * kDependent;
      break;
    }
    for (int k = 0; k < active_.count(); ++k) result.active[k] = active_.row(k);
    result.active_count = active_.count();
    const double share = std::fmin(feasible_share(), nearest_share());
    if ((1 - share) * std::sqrt(dot(x_, x_)) > kNearestTwistSlack) result.nearest = false;
    const bool untouched = result.iterations == 0 && share == 1;
    for (int i = 0; i < kSize; ++i) result.x[i] = untouched ? wanted_[i] : x_.v[i] * share * scale_;
  }

  /// The half-space that x violates most; of equal ones the first. Lists those that it violates most.
  Violated max_violated() {
    listed_.clear();
    const std::vector<double>& distances = rows_.distances(x_);
    for (std::size_t i = 0; i < distances.size(); ++i)
      if (distances[i] > kViolation && !active_.contains(static_cast<int>(i)))
        listed_.push_back({static_cast<int>(i), distances[i]});
    if (listed_.empty()) return {};
    const auto before = [](const Violated& a, const Violated& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.index < b.index;
    };
    const std::size_t count = std::min(kListed, listed_.size());
    std::partial_sort(listed_.begin(), listed_.begin() + static_cast<std::ptrdiff_t>(count), listed_.end(), before);
    listed_.resize(count);
    return listed_.front();
  }

  /// That of the listed ones: examined alone as long as one of them is violated (partial pricing).
  Violated max_of_listed() const {
    Violated worst{-1, kViolation};
    for (const Violated& listed : listed_) {
      const Row row = rows_[static_cast<std::size_t>(listed.index)];
      const double distance = row.bound - dot(row.normal, x_);
      if (distance > worst.distance && !active_.contains(listed.index)) worst = {listed.index, distance};
    }
    return worst;
  }

  /// Makes a violated row active and drops rows whose multipliers would become negative. False if that is impossible.
  bool activate(int index, int& iterations) {
    const Row row = rows_[static_cast<std::size_t>(index)];
    double multiplier = 0;
    while (iterations < kNearestTwistIterations) {
      ++iterations;
      const ActiveSet::Split split = active_.split(row.normal);
      const ActiveSet::Blocking blocking = active_.blocking(split);
      const double squared = split.length * split.length;
      const double violation = row.bound - dot(row.normal, x_);
      const double full =
          split.length > 0 ? std::fmax(0.0, violation) / squared : std::numeric_limits<double>::infinity();
      if (blocking.index < 0 && !(split.length > 0)) return false;
      const double step = std::fmin(full, blocking.step);
      if (split.length > 0) x_ = advanced(x_, step, split.outside);
      active_.advance(step, split);
      multiplier += step;
      if (full <= blocking.step) {
        active_.add(index, row, multiplier, split);
        return true;
      }
      active_.drop(blocking.index);
    }
    return false;
  }

  /// The largest share of x that is in every half-space. They are convex and contain 0.
  double feasible_share() {
    double share = 1;
    const std::vector<double>& distances = rows_.distances(x_);
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (!(distances[i] > kNearestTwistSlack / 4)) continue;
      const Row row = rows_[i];
      const double value = dot(row.normal, x_);
      const double limit = row.bound - kNearestTwistSlack / 2;
      if (value < limit) share = std::fmin(share, limit / value);
    }
    return share;
  }

  /// The share of x that is nearest to the wanted twist: below 1 only by rounding.
  double nearest_share() const {
    Vec6 wanted;
    for (int i = 0; i < kSize; ++i) wanted.v[i] = wanted_[i] / scale_;
    const double along = dot(wanted, x_), squared = dot(x_, x_);
    return along < squared ? std::fmax(0.0, along / squared) : 1;
  }

  const double (&wanted_)[kSize];
  double scale_;
  Rows rows_;
  std::vector<Violated> listed_;
  Vec6 x_;  // in units of scale_
  ActiveSet active_;
  NearestTwist result_;
};

[[maybe_unused]] bool all_contain_zero(Span<const HalfSpace> half_spaces) {
  return std::all_of(half_spaces.begin(), half_spaces.end(), [](const HalfSpace& h) { return h.bound <= 0; });
}

}  // namespace

NearestTwist nearest_twist(const double (&wanted)[6], Span<const HalfSpace> half_spaces, int cuts,
                           const TwistCuts& cut) {
  DISMANTLE_EXPECT(all_contain_zero(half_spaces));
  const double scale = safe_length(wanted);
  if (!(scale > 0)) return {};
  Search search(wanted, scale);
  NearestTwist found = search.add(half_spaces);
  for (; cuts > 0; --cuts) {
    const std::vector<HalfSpace> more = cut(found);
    DISMANTLE_EXPECT(all_contain_zero(more));
    if (more.empty()) break;
    found = search.add(more);
  }
  return found;
}

NearestTwist nearest_twist(const double (&wanted)[6], Span<const HalfSpace> half_spaces) {
  return nearest_twist(wanted, half_spaces, 0, {});
}

}  // namespace dismantle
