// SPDX-License-Identifier: Apache-2.0
#include "bench/families/path_judge.h"

#include "bench/families/depth_search.h"
#include "bench/families/scene.h"
#include "bench/timing.h"

#include <algorithm>
#include <utility>

namespace dismantle::families {

namespace {

/// The engine may declare up to this multiple of an allowance.
constexpr double kDeclared = 1.25;
/// Two that are further apart than so many tolerances have been apart.
constexpr double kApart = 3;
constexpr std::size_t kPiecesLater = 2500;
/// Of an overlap, the only places that are left for a ghost may be at its full allowance, and small.
constexpr double kGhostSlack = 1.1;
/// Samples near a point lie within so many allowances of it.
constexpr double kNear = 4;
constexpr std::size_t kMaxDoubts = 40;
/// No more points are followed, and no more depths searched for, after so long [s of this thread].
constexpr double kSeconds = 6;

/// Points of a surface: vertices, points of edges and faces, and points near given ones.
std::vector<Vec3> sample(const OracleMesh& surface, const std::vector<Vec3>& near, double reach, std::size_t count,
                         Dice& dice) {
  const TriangleMesh& mesh = surface.mesh();
  std::vector<Vec3> points = mesh.vertices;
  if (points.size() > count) {
    std::shuffle(points.begin(), points.end(), dice.random);
    points.resize(count);
  }
  const double faces = static_cast<double>(mesh.faces.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto f = static_cast<std::size_t>(std::min(faces - 1, dice.uniform(0, faces)));
    const Triangle t = mesh.triangle(i < mesh.faces.size() && mesh.faces.size() <= count ? i : f);
    const double u = dice.uniform(0, 1), v = dice.uniform(0, 1 - u);
    const int k = dice.whole(0, 2);
    if (i % 2 == 0) points.push_back(t[k] + u * (t[(k + 1) % 3] - t[k]));
    points.push_back(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
  }
  for (const Vec3& p : near)
    for (const double by : {0.0, 0.3, 1.0, kNear}) {
      const NearestFace found = surface.nearest(p + by * reach * dice.direction());
      points.push_back(found.point);
    }
  return points;
}

class Judge {
 public:
  Judge(const JudgedPair& pair, const std::vector<Pose>& poses, const JudgeOptions& options)
      : pair_(pair), options_(options), track_(poses), random_(options.seed) {}

  Verdict run() {
    const double tolerance = pair_.tolerance;
    const FoundDepth start = search_depth(pair_.moving, pair_.fixed, track_.at(0), {kTouching / 2 * tolerance});
    verdict_.start_depth = start.attained > 0 ? start.bound : 0;
    const bool overlaps = verdict_.start_depth > kTouching * tolerance;
    initial_ = verdict_.start_depth + tolerance;
    allowance_ = {options_.slack * tolerance, options_.slack * tolerance, SIZE_MAX};
    if (overlaps) allowance_.limit = initial_ + options_.extra * tolerance;
    if (overlaps || options_.declared > tolerance) {
      initial_ = std::max(initial_, std::min(options_.declared, initial_ + options_.sagittas));
      allowance_.limit =
          std::max(allowance_.limit, std::min(options_.declared, kDeclared * initial_) + kTouching * tolerance);
      find_parting();
    }
    if (start.attained > 0) (start.of_first ? deep_moving_ : deep_fixed_).push_back(start.at);
    search_depths();
    follow_points();
    return verdict_;
  }

 private:
  void find_parting() {
    for (std::size_t k = 0; k < track_.count(); ++k) {
      if (k > 0 && track_.pose(k) == track_.pose(k - 1)) continue;
      if (!apart(pair_.moving, pair_.fixed, track_.at(static_cast<double>(k)),
                 options_.sagittas + kApart * pair_.tolerance))
        continue;
      allowance_.parted_at = k;
      return;
    }
  }

  void search_depths() {
    Dice dice{random_};
    std::vector<double> times;
    const double end = track_.end();
    for (int i = 0; i < options_.depths; ++i) {
      const double time = end - dice.uniform(i, i + 1) * end / options_.depths;
      times.push_back(dice.chance(0.5) ? std::ceil(time) : time);
    }
    times.push_back(end);
    const bench::Stopwatch watch(bench::thread_ns);
    for (const double time : times) {
      if (watch.seconds() > kSeconds) return;
      const double at = std::clamp(time, 0.0, end);
      const auto frame = static_cast<std::size_t>(at);
      const double limit = allowance_.at(frame);
      const double floor = std::max(0.3 * pair_.tolerance, frame >= allowance_.parted_at ? 0 : verdict_.start_depth);
      const FoundDepth found =
          search_depth(pair_.moving, pair_.fixed, track_.at(at), {0.05 * pair_.tolerance, kPiecesLater, floor});
      const double allowed = frame >= allowance_.parted_at ? pair_.tolerance : initial_;
      verdict_.ratio = std::max(verdict_.ratio, found.attained / allowed);
      if (found.attained > 0.5 * limit) (found.of_first ? deep_moving_ : deep_fixed_).push_back(found.at);
      if (found.attained <= limit || verdict_.beyond) continue;
      verdict_.beyond = true;
      verdict_.beyond_at = at;
    }
  }

  void follow_points() {
    Dice dice{random_};
    const bench::Stopwatch watch(bench::thread_ns);
    const ScrewTrack back = track_.seen_from_body();
    std::vector<std::pair<Vec3, bool>> points;
    for (const bool moving : {true, false}) {
      std::vector<Vec3> near = moving ? options_.near_moving : options_.near_fixed;
      const std::vector<Vec3>& deep = moving ? deep_moving_ : deep_fixed_;
      near.insert(near.end(), deep.begin(), deep.end());
      for (const Vec3& p : sample(moving ? pair_.moving : pair_.fixed, near, pair_.tolerance, options_.samples, dice))
        points.emplace_back(p, moving);
    }
    std::shuffle(points.begin(), points.end(), random_);
    for (const auto& [p, moving] : points) {
      if (verdict_.passed || verdict_.doubted > kMaxDoubts || watch.seconds() > kSeconds) return;
      follow(moving ? pair_.fixed : pair_.moving, moving ? track_ : back, p, moving);
    }
  }

  void follow(const OracleMesh& other, const ScrewTrack& track, Vec3 point, bool moving) {
    PointAllowance allowance = allowance_;
    if (initial_ > pair_.tolerance) allowance.limit *= kGhostSlack;
    if (!GhostOracle(other, track, allowance).follow(point, {})) return;
    const GhostEffort closer{60, 120, 60, 0.02, 0.3};
    const auto lost = GhostOracle(other, track, allowance).follow(point, closer);
    if (!lost) {
      ++verdict_.doubted;
      return;
    }
    verdict_.passed = true;
    verdict_.passed_at = *lost;
    verdict_.passed_moving = moving;
    verdict_.passed_point = point;
    for (const double factor : {1.1, 1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0}) {
      verdict_.passed_by = factor;
      PointAllowance more = allowance;
      more.limit *= factor;
      more.limit_after_parting *= factor;
      if (!GhostOracle(other, track, more).follow(point, closer)) break;
    }
  }

  const JudgedPair& pair_;
  const JudgeOptions& options_;
  ScrewTrack track_;
  std::mt19937_64 random_;
  PointAllowance allowance_;
  double initial_ = 0;  // the allowance until the two have been apart
  Verdict verdict_;
  std::vector<Vec3> deep_moving_, deep_fixed_;
};

}  // namespace

Verdict judge(const JudgedPair& pair, const std::vector<Pose>& poses, const JudgeOptions& options) {
  return Judge(pair, poses, options).run();
}

}  // namespace dismantle::families
